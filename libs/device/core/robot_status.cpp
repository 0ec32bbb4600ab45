#include "handway/device/core/robot_status.h"

#include <fmt/format.h>

namespace handway::device {

std::optional<RobotObstacle> obstacle_to_start(const RobotStatus& status) {
  if (status.emergency_stopped == 1) {
    return RobotObstacle{"an emergency stop", "Release it."};
  }
  if (status.in_error == 1) {
    return RobotObstacle{"a controller in error", "Look at its pendant."};
  }
  if (status.drives_powered == 0) {
    return RobotObstacle{"drives without power", "Switch arm power on."};
  }
  if (status.mode == 1) {
    return RobotObstacle{"manual mode", "Switch to remote or automatic mode."};
  }
  if (status.motion_possible == 0) {
    return RobotObstacle{"a controller that can't move now", "Look at its pendant."};
  }
  return std::nullopt;
}

std::optional<RobotObstacle> obstacle_under_way(const RobotStatus& status) {
  if (status.emergency_stopped == 1) {
    return RobotObstacle{"an emergency stop", "Find out why before you release it."};
  }
  if (status.in_error == 1) {
    return RobotObstacle{fmt::format("error {} of the controller", status.error_code),
                         "Look at its pendant."};
  }
  if (status.drives_powered == 0) {
    return RobotObstacle{"drives without power", "Look at the controller's pendant."};
  }
  return std::nullopt;
}

}  // namespace handway::device
