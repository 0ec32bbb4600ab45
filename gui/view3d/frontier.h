#pragma once

#include "handway/geometric/robot/robot_state.h"

#include <string>
#include <vector>

namespace handway::gui {

/// Farthest configurations of a search that found no path.
struct Frontier {
  geometric::Configuration from_start;
  geometric::Configuration from_goal;
  /// The bodies that collided most, names as in CollisionWorld.
  std::vector<std::string> colliding;
};

}  // namespace handway::gui
