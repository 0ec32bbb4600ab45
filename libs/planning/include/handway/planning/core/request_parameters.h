#pragma once

#include "handway/geometric/io/parameter.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/export.h"

#include <vector>

namespace handway::planning {

/// Describes the settings of a request that users choose, but its seed.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<geometric::BoundParameter> parameters_of(
    PlanRequest& request);

}  // namespace handway::planning
