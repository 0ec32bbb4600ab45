#pragma once

#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/export.h"

#include <Eigen/Core>

#include <vector>

namespace handway::geometric {

/// How far two bodies of a pair can move against each other when the joints
/// move: the farthest that any point of one can travel in the frame of the other
/// per unit of each variable, over all configurations. Couplings are included.
///
/// Source: Schwarzer, Saha, Latombe, "Adaptive dynamic collision checking for
/// single and multiple articulated robots in complex environments", IEEE
/// Transactions on Robotics 21(3), 2005.
class HANDWAY_GEOMETRIC_EXPORT MotionBound {
 public:
  explicit MotionBound(const CollisionWorld& world);

  /// Upper bound (m) of the change of the pair's distance when every variable v
  /// moves by at most `travel[v]`. @param travel shape [variable_count], ≥ 0.
  [[nodiscard]] double bound(int pair, const Eigen::VectorXd& travel) const {
    return reach_.col(pair).dot(travel);
  }

  /// The same for any point of the robot in the world: the measure of edge
  /// resolution in millimetres.
  [[nodiscard]] double any_point(const Eigen::VectorXd& travel) const {
    return farthest_.dot(travel);
  }

 private:
  Eigen::MatrixXd reach_;     ///< Shape [variable_count x pairs], m per rad or m per m.
  Eigen::VectorXd farthest_;  ///< Shape [variable_count].
};

}  // namespace handway::geometric
