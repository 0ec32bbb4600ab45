#pragma once

#include "handway/geometric/scene/scene.h"
#include "model/playback/path_timeline.h"

#include <vector>

namespace handway::gui {

/// The way of one link's origin through the world, m.
struct PalmPath {
  std::vector<Eigen::Vector3d> points;     ///< Close together, along the whole path.
  std::vector<Eigen::Vector3d> waypoints;  ///< One for each of the path's.
};

/// @param link of the robot, for example its palm.
[[nodiscard]] PalmPath palm_path(const geometric::RobotInstance& robot,
                                 const PathTimeline& timeline, int link);

}  // namespace handway::gui
