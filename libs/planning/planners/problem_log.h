#pragma once

#include "handway/planning/planners/planner.h"

namespace handway::planning {

/// Keeps the problem for whoever looks for a fault, if $HANDWAY_LOG_PROBLEMS names a folder: in a
/// folder of its own there, the scene with the problem's ends, the hand's basis and the command
/// that plans it again. What can't be written is a warning in the program's log.
void log_problem(Planner& planner, const PlanningProblem& problem, const PlanRequest& request);

}  // namespace handway::planning
