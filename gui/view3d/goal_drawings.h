#pragma once

#include "handway/geometric/scene/scene.h"
#include "view3d/drawing.h"

#include <Eigen/Core>

#include <span>

namespace handway::gui {

/// Result of a check whether a robot reaches a pose.
enum class PoseReached { kUnknown, kYes, kNo };

/// Draws the frames of the scene's goal poses, red, green and blue for x, y and z, with a box
/// around where their tolerances let the tool be, and a dot: green if the pose is reached, red if
/// not. @param reached of each pose, in order; what is left out is unknown.
[[nodiscard]] Drawing make_goal_poses_node(const geometric::Scene& scene,
                                           std::span<const PoseReached> reached);

/// Makes the marker of a tool's target: a green dot or, if it is out of reach, a red one with a
/// line to the nearest position of the tool. Points in the world, m.
[[nodiscard]] Drawing make_reach_node(const Eigen::Vector3d& target, const Eigen::Vector3d& tool,
                                      bool reached);

}  // namespace handway::gui
