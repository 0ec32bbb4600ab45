#pragma once

#include "handway/geometric/collision/narrow_phase/contact.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

#include <string>
#include <vector>

namespace handway::planning {

/// Returns what the scene may have meant where `q` is in collision, as sentences:
///   - that a closed object which the robot is inside of, as a cell or a room, may be hollow;
///   - that an object which is carried may touch the links that hold it.
/// @param contacts of `q`, as find_contacts() gives them.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<std::string> contact_hints(
    const PlanningProblem& problem, const Configuration& q,
    const std::vector<geometric::Contact>& contacts);

}  // namespace handway::planning
