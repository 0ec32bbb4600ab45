#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/planner_registry.h"

#include <memory>
#include <string>

namespace handway::tools {

/// The planner called `name` (empty: the scene's, or else the first in the registry).
/// The scene's settings are taken if they are for it; another planner's mean nothing.
/// @throws InputError for an unknown planner or setting.
[[nodiscard]] std::unique_ptr<planning::Planner> scene_planner(
    const std::string& name, const geometric::PlannerChoice& choice,
    const planning::PlannerRegistry& registry);

}  // namespace handway::tools
