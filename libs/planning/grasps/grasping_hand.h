#pragma once

#include "handway/planning/core/planning_problem.h"

#include <string_view>

namespace handway::planning {

/// Returns an object of the scene that the robot's hand may grasp.
/// @throws InputError if there is none of that name, it is attached, it has no surface, or the
/// robot has no free hand.
[[nodiscard]] const geometric::SceneObject& graspable_object(const PlanningProblem& problem,
                                                             std::string_view name);

/// Selects the hand that is nearest to an object where the robot starts, and its arm; the other
/// hands, and their arms, stay.
[[nodiscard]] PlanningProblem with_nearest_hand(const PlanningProblem& problem,
                                                const geometric::SceneObject& object);

}  // namespace handway::planning
