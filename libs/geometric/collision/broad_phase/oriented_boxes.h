#pragma once

#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/math/pose.h"

#include <cstdint>
#include <span>
#include <vector>

namespace handway::geometric {

/// A box around each body of a world, along the axes of its mesh's frame: for long and slim bodies
/// side by side, such as fingers, whose spheres overlap.
///
/// Two boxes are separated if the axis of a face separates them. Axes of pairs of edges are not
/// tested: they add hardly anything (Gottschalk, Lin and Manocha, "OBBTree", 1996).
class OrientedBoxes {
 public:
  /// Axis that separated each pair last. It affects the time of an answer, not the answer.
  using LastAxes = std::vector<std::uint8_t>;

  explicit OrientedBoxes(const CollisionWorld& world);

  /// For every pair.
  [[nodiscard]] LastAxes last_axes() const { return LastAxes(pairs_.size()); }

  /// Returns whether face axes show that the boxes of the pair's bodies are at least `distance` (m)
  /// apart. @param X_WBody shape [bodies].
  [[nodiscard]] bool are_apart(int pair, std::span<const Pose> X_WBody, double distance,
                               LastAxes& last) const;

 private:
  struct Box {
    Eigen::Vector3d centre;  ///< m, in the body's frame.
    Eigen::Vector3d half;
  };

  std::span<const BodyPair> pairs_;  ///< The world's.
  std::vector<Box> boxes_;           ///< Per body.
};

}  // namespace handway::geometric
