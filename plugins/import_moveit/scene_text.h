#pragma once

#include <filesystem>
#include <string>

namespace handway::import_moveit {

/// Returns whether a file is a scene as RViz' MotionPlanning panel exports it (.scene).
[[nodiscard]] bool is_scene_text(const std::filesystem::path& file);

/// Reads such a scene as a moveit_msgs/PlanningScene (YAML) for the robot in $HANDWAY_ROBOT: the
/// file itself names none. Objects are in the frame of the robot's root; their subframes are left
/// out.
///
/// Format: planning_scene::PlanningScene::saveGeometryToStream() of MoveIt, before and since
/// Noetic.
/// @throws InputError naming the line, or if no robot is named.
[[nodiscard]] std::string planning_scene_of(const std::filesystem::path& file);

}  // namespace handway::import_moveit
