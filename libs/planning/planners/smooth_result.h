#pragma once

#include "handway/planning/core/plan_result.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/paths/path.h"
#include "handway/sampling/postures/pmd_basis.h"

namespace handway::planning {

/// Makes `found`, as ShortcutSmoothing leaves it, the path of `result`; the time
/// it takes is the result's smoothing time.
/// @param checks configurations to spend on it.
void smooth_result(PlanningContext& context, const sampling::PmdBasis& basis, int checks,
                   const Path& found, PlanResult& result);

}  // namespace handway::planning
