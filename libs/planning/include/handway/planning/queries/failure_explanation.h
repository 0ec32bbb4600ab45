#pragma once

#include "handway/planning/core/plan_result.h"
#include "handway/planning/export.h"

#include <string>
#include <vector>

namespace handway::planning {

/// Why a search found no path, one sentence each, as far as it is known: how far it came from both
/// ends, whether an end is boxed in, which bodies collided in most of the samples that were
/// rejected and where along the motion, and what to try. Empty for a path, and where an end is not
/// valid: the result's reason says that.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<std::string> explain_failure(
    const PlanResult& result);

}  // namespace handway::planning
