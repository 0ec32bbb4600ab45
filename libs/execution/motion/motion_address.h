#pragma once

#include "handway/device/core/device_address.h"
#include "handway/device/ros/ros_robot.h"

#include <string>
#include <variant>

namespace handway::execution {

/// A device as `--to` names it.
struct MotionAddress {
  std::string text;  ///< As it was written.
  std::string part;  ///< Of the robot: "arm", "hand" or kWholeRobot.
  /// Of a VAL3 server or a hand; or of a robot in ROS.
  std::variant<device::TcpAddress, device::RosAddress> where;
};

/// Reads "arm://HOST[:PORT]", "hand://HOST[:PORT]", "ros://HOST[:PORT][/CONTROLLER][#arm|#hand]" or
/// "ros2://" the same.
/// @throws InputError for anything else.
[[nodiscard]] MotionAddress parse_motion_address(const std::string& text);

}  // namespace handway::execution
