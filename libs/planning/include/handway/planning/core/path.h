#pragma once

#include "handway/geometric/math/pose.h"

#include <vector>

namespace handway::planning {

/// A polyline in configuration space; between two waypoints all joints move
/// linearly together.
struct Path {
  std::vector<geometric::Configuration> waypoints;

  [[nodiscard]] bool empty() const { return waypoints.empty(); }
};

}  // namespace handway::planning
