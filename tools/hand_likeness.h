#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/paths/path.h"
#include "handway/planning/queries/human_likeness.h"

#include <filesystem>
#include <optional>

namespace handway::tools {

/// How human the hand looks along a path; nothing if the problem has no basis, or no path.
/// @param postures file to compare with; empty: those that the basis names, if any.
/// @throws InputError if the postures can't be read, or files are given and there's no basis.
[[nodiscard]] std::optional<planning::PathLikeness> hand_likeness(
    const planning::PlanningProblem& problem, const planning::Path& path,
    const std::filesystem::path& postures = {});

}  // namespace handway::tools
