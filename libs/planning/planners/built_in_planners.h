#pragma once

#include "handway/planning/core/planner_registry.h"

namespace handway::planning {

/// Adds the planners that come with the library, the default one first.
void register_built_in_planners(PlannerRegistry& registry);

}  // namespace handway::planning
