#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/importer.h"

#include <filesystem>

namespace handway::gui {

/// Writes a scene as Handway's own format, the first robot standing at `shown`.
/// The hand's basis of an imported problem goes into `STEM_hand.yaml` beside it.
/// @param shown shape [variable_count] of the first robot; unused without robots.
/// @throws InputError if a file can't be written.
void save_scene(const planning::LoadedScene& loaded, const geometric::Configuration& shown,
                const geometric::PlannerChoice& planner, const std::filesystem::path& file);

}  // namespace handway::gui
