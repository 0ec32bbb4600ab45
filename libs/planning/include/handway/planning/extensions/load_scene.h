#pragma once

#include "handway/planning/edits/scene_state.h"
#include "handway/planning/export.h"

#include <filesystem>

namespace handway::planning {

class PluginManager;

/// Opens a scene file: Handway's own YAML, a robot, or any format of an importer; or a robot of the
/// library by its name. A basis that the scene names is loaded too.
/// @throws InputError if the file can't be read or is of an unknown format.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState load_scene(const std::filesystem::path& file,
                                                            const PluginManager& plugins);

}  // namespace handway::planning
