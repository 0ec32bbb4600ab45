#pragma once

#include "handway/planning/core/objective_settings.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/paths/path.h"

namespace handway::planning {

/// Makes `found`, as a PathOptimizer leaves it, the path of `result`; the time it takes is added to
/// the result's smoothing time.
/// @param checks configurations to spend on it for every 16 waypoints.
/// @param most_rounds up to so many times as many are spent where the hand stays farther from the
/// PMD subspace than the ends force it to, and half as many where the length alone counts.
void smooth_result(PlanningContext& context, const ObjectiveSettings& objective, int checks,
                   const Path& found, PlanResult& result, int most_rounds = 1);

}  // namespace handway::planning
