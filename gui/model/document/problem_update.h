#pragma once

#include "handway/planning/core/importer.h"
#include "handway/planning/core/planning_problem.h"

namespace handway::gui {

/// What planning::make_problem() makes of an edited scene, sharing with the problem
/// of the scene before all that the edit left alone: the checker, or at least
/// the meshes that it has prepared.
/// @param scene with start and goal. @throws InputError and PreparationStopped as make_problem().
[[nodiscard]] planning::PlanningProblem updated_problem(
    const planning::PlanningProblem& before, const planning::LoadedScene& scene,
    const geometric::Preparation& preparation = {});

}  // namespace handway::gui
