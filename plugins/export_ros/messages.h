#pragma once

#include "handway/planning/core/exporter.h"

#include <nlohmann/json.hpp>

/// ROS messages as trees of named values, in the order of their definitions.
namespace handway::export_ros {

using Message = nlohmann::ordered_json;

/// How a version of ROS calls the parts of a time: {secs, nsecs} or {sec, nanosec}; and
/// only the first has `seq` in its headers.
enum class RosVersion { kRos1, kRos2 };

/// std_msgs/Header with time 0, which means "now".
[[nodiscard]] Message header(RosVersion version);

/// trajectory_msgs/JointTrajectory of the joints that move on their own: the effort arrays
/// are empty, times increase strictly.
[[nodiscard]] Message joint_trajectory(const planning::Motion& motion, RosVersion version);

/// moveit_msgs/RobotState: where the motion begins, with the coupled joints.
[[nodiscard]] Message start_state(const planning::Motion& motion, RosVersion version);

}  // namespace handway::export_ros
