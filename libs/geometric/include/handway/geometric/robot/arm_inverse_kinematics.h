#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/inverse_kinematics.h"
#include "handway/geometric/robot/numeric_inverse_kinematics.h"

#include <memory>
#include <vector>

namespace handway::geometric {

/// Inverse kinematics of an arm in closed form, for a link that it carries; null if the arm has
/// another structure, or other variables than the arm's move the link.
/// @param arm the arm's variables.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::unique_ptr<InverseKinematics>
closed_form_inverse_kinematics(const std::shared_ptr<const RobotModel>& model, int tip_link,
                               const JointIndices& arm);

/// Iterative solver with those of the arm's variables that move the link.
/// @throws InputError if no variable does, or as NumericInverseKinematics.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::unique_ptr<NumericInverseKinematics>
iterative_inverse_kinematics(const std::shared_ptr<const RobotModel>& model, int tip_link,
                             const JointIndices& arm, const NumericIkOptions& options);

/// In closed form if available, else iterative.
/// @throws InputError as iterative_inverse_kinematics().
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::unique_ptr<InverseKinematics>
make_arm_inverse_kinematics(const std::shared_ptr<const RobotModel>& model, int tip_link,
                            const JointIndices& arm, const NumericIkOptions& options);

/// A ball that contains the origin of a link in all configurations, in the robot's base frame.
struct ReachBall {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< The arm's first joint, m.
  double radius = 0.0;                               ///< m; above the reach by the losses of bends.

  [[nodiscard]] bool contains(const Eigen::Vector3d& p_B) const {
    return (p_B - centre).norm() <= radius;
  }
};

/// Returns a ball that contains every position to which the arm can bring a link within its limits.
/// @param q joints that are not the arm's, shape [variable_count].
/// @throws InputError if no variable of the arm moves the link.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT ReachBall reach_ball(const RobotModel& model, int link,
                                                            const JointIndices& arm,
                                                            const Configuration& q);

}  // namespace handway::geometric
