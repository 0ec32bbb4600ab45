#pragma once

#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/math/pose.h"

#include <cstdint>
#include <span>
#include <vector>

namespace handway::geometric {

/// A box around each body of a world, along the axes of its mesh's frame: long and slim
/// bodies side by side, as fingers are, whose spheres overlap.
///
/// Two boxes are apart where the axis of a face separates them; those of pairs of edges, which
/// tell hardly more, aren't looked at (Gottschalk, Lin and Manocha, "OBBTree", 1996).
class OrientedBoxes {
 public:
  /// Axis that separated each pair last. It affects the time of an answer, not the answer.
  using LastAxes = std::vector<std::uint8_t>;

  explicit OrientedBoxes(const CollisionWorld& world);

  /// For every pair.
  [[nodiscard]] LastAxes last_axes() const { return LastAxes(pairs_.size()); }

  /// Are the boxes of the pair's bodies at least `distance` (m) apart, as far as their faces
  /// tell? @param X_WBody shape [bodies].
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
