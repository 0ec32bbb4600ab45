#pragma once

#include "handway/device/export.h"

#include <cstdint>
#include <optional>
#include <string>

namespace handway::device {

/// Status that a controller reports: -1 unknown, 0 no, 1 yes. The fields are those of
/// ROS-Industrial's message RobotStatus, both in its simple message protocol and in ROS.
struct RobotStatus {
  std::int32_t drives_powered = -1;
  std::int32_t emergency_stopped = -1;
  std::int32_t error_code = 0;
  std::int32_t in_error = -1;
  std::int32_t in_motion = -1;
  std::int32_t mode = -1;  ///< -1 unknown, 1 manual, 2 automatic.
  std::int32_t motion_possible = -1;

  bool operator==(const RobotStatus&) const = default;
};

/// Reason why a robot does not move, with advice.
struct RobotObstacle {
  std::string found;
  std::string advice;
};

/// @returns why no motion can begin; nothing if one can. Unknown fields are no reason.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::optional<RobotObstacle> obstacle_to_start(
    const RobotStatus& status);

/// @returns why a running motion has ended; nothing if it continues.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::optional<RobotObstacle> obstacle_under_way(
    const RobotStatus& status);

}  // namespace handway::device
