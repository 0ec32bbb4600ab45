#pragma once

#include "handway/geometric/robot/robot_model.h"

#include <string>
#include <vector>

namespace handway::gui {

/// How far a search that found no path came, in the robot's configurations.
struct Frontier {
  geometric::Configuration from_start;
  geometric::Configuration from_goal;
  /// The bodies that collided most, names as in CollisionWorld.
  std::vector<std::string> colliding;
};

}  // namespace handway::gui
