#pragma once

#include "collision/sphere_cover.h"
#include "collision/still_bodies.h"
#include "handway/geometric/collision/collision_world.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace handway::geometric {

/// Lower bounds of the distances of all pairs of a world from one volume a body:
/// the sphere around what moves, against another such sphere or against the box
/// of what stands still.
class RootBounds {
 public:
  /// Where the spheres of one configuration are, m, in the world; shape [bodies].
  struct Placement {
    std::vector<float> x, y, z;
    std::vector<float> bounds;  ///< Room for what is computed; shape [pairs].
    std::vector<int> candidates;
  };

  /// @param spheres shape [bodies], around each body in its own frame.
  RootBounds(const CollisionWorld& world, std::vector<BoundingSphere> spheres);

  [[nodiscard]] Placement placement() const;
  /// @param X_WBody shape [bodies].
  void place(std::span<const Pose> X_WBody, Placement& placement) const;

  /// Sets `pairs` to all that may be nearer than `tolerance` (m), in order.
  void find_near(Placement& placement, double tolerance, std::vector<int>& pairs) const;

  /// A lower bound (m) of the pair's distance; negative where the volumes overlap.
  [[nodiscard]] double bound(const Placement& placement, int pair) const;

 private:
  struct Range {
    std::size_t first;
    std::size_t end;
  };
  void bound_moving(const Placement& at, Range pairs, float* bounds) const;
  /// The range counts from the first pair with what stands still.
  void bound_still(const Placement& at, Range pairs, float* bounds) const;
  void find_near_still(Placement& placement, double tolerance, std::vector<int>& pairs) const;

  std::vector<BoundingSphere> spheres_;
  std::vector<std::uint32_t> a_;  ///< Per pair: the body that moves …
  std::vector<std::uint32_t> b_;  ///< … and the other.
  std::vector<float> radii_;      ///< Of both spheres, or of a's, with room for roundings.
  std::size_t moving_ = 0;        ///< So many pairs come first in which both move.
  /// Of each other pair's still body: R and p of X_BoxWorld, row by row, and half the edges.
  std::array<std::vector<float>, 12> X_BoxW_;
  std::array<std::vector<float>, 3> half_;
  std::vector<int> bodies_;           ///< That move.
  std::optional<StillBodies> still_;  ///< Where there are many.
};

}  // namespace handway::geometric
