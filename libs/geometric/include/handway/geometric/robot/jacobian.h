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

/// Returns the Jacobian of a point Q of `link`, measured and expressed in the world frame W.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Jacobian point_jacobian(
    const RobotState& state, int link, const Eigen::Vector3d& p_LQ = Eigen::Vector3d::Zero());

/// Yoshikawa's measure of manipulability: the volume, up to a constant, of the ellipsoid of a
/// task's speeds for joint speeds of norm 1; 0 in a singular posture. For chains with fewer joints
/// than task coordinates: the volume in the directions in which they can move.
///
/// Source: T. Yoshikawa, "Manipulability of robotic mechanisms", Int. J. Robotics Research 4(2),
/// 1985.
/// @param J shape [task, joints], both at least 1: rows and columns of a Jacobian. Its units weight
/// the measure; three rows of one unit are the usual choice.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT double manipulability(const Eigen::MatrixXd& J);

/// The part of joint speeds `wanted` that moves a redundant chain without effect on the task: its
/// projection into the null space of J. Zero, but for rounding, for a chain that is not redundant.
/// @param J shape [task, joints]. @param wanted shape [joints].
/// @param damping of the inverse, in J's units squared, > 0: near singular postures, where
/// directions of the task are almost lost, larger values sacrifice the task instead of the joint
/// speeds.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Eigen::VectorXd null_space_motion(
    const Eigen::MatrixXd& J, const Eigen::VectorXd& wanted, double damping = 1e-9);

}  // namespace handway::geometric
