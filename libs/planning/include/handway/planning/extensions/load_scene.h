#pragma once

#include "handway/geometric/robot/robot_description.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/export.h"

#include <filesystem>

namespace handway::planning {

class PluginManager;

/// Opens a scene file: Handway's own YAML, a robot, or any format of an importer; or a robot of the
/// library by its name. A basis that the scene names is loaded too.
/// @param arguments of a robot file in xacro. Those of $HANDWAY_XACRO count for every xacro file.
/// @throws InputError if the file can't be read or is of an unknown format, or there are arguments
/// and no xacro file.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState
load_scene(const std::filesystem::path& file, const PluginManager& plugins,
           const geometric::XacroArguments& arguments = {});

}  // namespace handway::planning
