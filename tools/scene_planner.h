#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/planner_registry.h"

#include <memory>
#include <string>
#include <vector>

namespace handway::tools {

/// The planner called `name` (empty: the scene's, or else the first in the registry).
/// The scene's settings are taken if they are for it; another planner's mean nothing.
/// @throws InputError for an unknown planner or setting.
[[nodiscard]] std::unique_ptr<planning::Planner> scene_planner(
    const std::string& name, const geometric::PlannerChoice& choice,
    const planning::PlannerRegistry& registry);

/// Sets parameters from the command line, KEY=VALUE each.
/// @throws CLI::ValidationError if one is not of this form, InputError for an unknown parameter or
/// a value that it can't have.
void apply_settings(planning::Planner& planner, const std::vector<std::string>& settings);

}  // namespace handway::tools
