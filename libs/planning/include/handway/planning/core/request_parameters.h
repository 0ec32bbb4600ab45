#pragma once

#include "handway/geometric/io/parameter.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/export.h"

#include <string_view>
#include <vector>

namespace handway::planning {

/// Describes a number of threads. @param result that does not depend on it: "the path".
[[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::BoundParameter threads_parameter(
    int& threads, std::string_view result);

/// Describes the settings of a request that users choose, but its seed.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<geometric::BoundParameter> parameters_of(
    PlanRequest& request);

/// Returns the settings of a request with their defaults.
[[nodiscard]] HANDWAY_PLANNING_EXPORT const std::vector<geometric::Parameter>& request_parameters();

}  // namespace handway::planning
