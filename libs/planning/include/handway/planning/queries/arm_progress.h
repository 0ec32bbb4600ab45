#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

namespace handway::planning {

/// Where the arm is on its straight motion from start to goal, in [0, 1]: of the nearest
/// configuration on it; 0 for an arm that has nothing to move.
[[nodiscard]] HANDWAY_PLANNING_EXPORT double arm_progress(const PlanningProblem& problem,
                                                          const Configuration& q);

}  // namespace handway::planning
