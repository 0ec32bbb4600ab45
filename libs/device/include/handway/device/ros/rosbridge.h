#pragma once

#include "handway/device/core/joint_trajectory.h"
#include "handway/device/core/robot_status.h"
#include "handway/device/export.h"

#include <Eigen/Core>

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// The rosbridge protocol, version 2.1 (RobotWebTools/rosbridge_suite, ROSBRIDGE_PROTOCOL.md): JSON
/// objects with a key `op`, one per WebSocket message. Only the part for moving joints.
namespace handway::device {

/// ROS 1 and ROS 2 name types and the parts of a duration differently.
enum class RosVersion { kRos1, kRos2 };

/// Thrown for a message that is no JSON object, or not of the form of its `op` and type.
class RosbridgeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `trajectory_msgs/JointTrajectory`: positions only, times are `time_from_start`.
struct RosTrajectory {
  std::vector<std::string> names;
  JointTrajectory motion;  ///< Times need not begin at 0.
};

/// `sensor_msgs/JointState`: positions only; shape [names].
struct RosJointState {
  std::vector<std::string> names;
  Eigen::VectorXd position;  ///< rad; NaN where the message had null.
};

/// One rosbridge message; its `op` decides which fields are valid.
struct RosbridgeMessage {
  std::string op;     ///< "advertise", "unadvertise", "subscribe", "publish", "status" …
  std::string id;     ///< Empty: none.
  std::string topic;  ///< For advertise, subscribe and publish.
  std::string type;   ///< For advertise and subscribe.
  std::string level;  ///< For status: "error", "warning" …
  std::string text;   ///< For status.
  // For publish: set if `msg` has the keys of a joint state.
  std::optional<RosJointState> joint_state;
  std::optional<RosTrajectory> trajectory;
  std::optional<RobotStatus> robot_status;
};

/// @throws RosbridgeError
[[nodiscard]] HANDWAY_DEVICE_EXPORT RosbridgeMessage parse_rosbridge(std::string_view text);

/// "trajectory_msgs/JointTrajectory", or "trajectory_msgs/msg/JointTrajectory" in ROS 2.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string ros_type(std::string_view package,
                                                         std::string_view name, RosVersion version);

/// Formats the message that announces the type of a topic to publish on.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string advertise(const std::string& topic,
                                                          const std::string& type);
/// @param id is returned in the status that answers a failed subscription.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string subscribe(const std::string& id,
                                                          const std::string& topic,
                                                          const std::string& type);
/// Formats the message that publishes a trajectory.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string publish(const std::string& topic,
                                                        const RosTrajectory& trajectory,
                                                        RosVersion version);
/// Formats the message that publishes the joints' positions.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string publish(const std::string& topic,
                                                        const RosJointState& state);
/// Formats the message that publishes a robot's state.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string publish(const std::string& topic,
                                                        const RobotStatus& status);
/// @param id of the message that this is about; empty: none.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string status(const std::string& level,
                                                       const std::string& text,
                                                       const std::string& id);

}  // namespace handway::device
