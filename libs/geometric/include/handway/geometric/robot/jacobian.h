#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/robot/robot_state.h"

#include <Eigen/Core>

#include <span>

namespace handway::geometric {

/// A geometric Jacobian, shape [6 x variable_count]. Rows 0 to 2 are the linear
/// velocity of a point (m/s), rows 3 to 5 the angular velocity of its link
/// (rad/s), per unit speed of each variable (rad/s or m/s). Coupled joints add
/// to their leader's column; variables that don't move the link have columns 0.
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Jacobian of the point Q fixed on `link`, measured and expressed in the
/// robot's base frame B.
/// @param X_BL poses of all links, as RobotModel::forward_kinematics gives them.
/// @param p_LQ the point in the link's frame, m.
/// @pre 0 ≤ link < model.link_count(), X_BL has model.link_count() poses.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Jacobian
point_jacobian(const RobotModel& model, std::span<const Pose> X_BL, int link,
               const Eigen::Vector3d& p_LQ = Eigen::Vector3d::Zero());

/// The same, measured and expressed in the world frame W.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Jacobian point_jacobian(
    const RobotState& state, int link, const Eigen::Vector3d& p_LQ = Eigen::Vector3d::Zero());

}  // namespace handway::geometric
