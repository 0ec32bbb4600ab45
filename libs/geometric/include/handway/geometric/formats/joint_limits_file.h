#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_description.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace handway::geometric {

/// Limits that a file gives for one joint; SI units, rates above 0. Empty: not given.
struct FiledJointLimits {
  std::string joint;
  std::optional<double> velocity;
  std::optional<double> acceleration;  ///< The lesser of acceleration and deceleration.
  std::optional<double> jerk;
  std::optional<double> lower;  ///< The narrower of position and soft limits.
  std::optional<double> upper;
};

/// Reads a file in the format of MoveIt and ros2_control: a map `joint_limits` of joints, each with
/// `has_position_limits`, `min_position`, `max_position`, `has_velocity_limits`, `max_velocity`,
/// `has_acceleration_limits`, `max_acceleration`, `has_deceleration_limits`, `max_deceleration`,
/// `has_jerk_limits`, `max_jerk`, `has_soft_limits`, `soft_lower_limit`, `soft_upper_limit` (all
/// optional). Limits whose flag is false don't count.
/// @param robot the robot. The file may have joints that it lacks, too.
/// @throws InputError naming line and key, also for a name that is almost that of a joint missing
/// in the file: limits that a user relies on must not be ignored.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<FiledJointLimits> read_joint_limits(
    const std::filesystem::path& file, const RobotDescription& robot);

/// Returns the file joint_limits.yaml beside the robot's file; empty if it does not exist.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::filesystem::path joint_limits_beside(
    const RobotDescription& robot);

/// Narrows the position limits of the robot's joints to those in joint_limits_beside(). A file that
/// can't be read, and limits that leave a joint no range, become warnings of the robot.
HANDWAY_GEOMETRIC_EXPORT void narrow_joint_limits(RobotDescription& robot);

}  // namespace handway::geometric
