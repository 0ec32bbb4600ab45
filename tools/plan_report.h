#pragma once

#include "handway/planning/core/objective.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/queries/human_likeness.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace handway::tools {

/// The JSON report of a run, keys as in docs/command-line.md.
/// @param likeness of the path's hand; nothing: there is no path, or no basis to compare with.
/// @param quality of the path; nothing: there is none.
[[nodiscard]] std::string plan_report(planning::Planner& planner,
                                      const planning::PlanningProblem& problem,
                                      const planning::PlanRequest& request,
                                      const planning::PlanResult& result, double load_s,
                                      const std::optional<planning::PathLikeness>& likeness,
                                      const std::optional<planning::PathQuality>& quality);

/// What a path is judged by, keys as `objective` in docs/command-line.md; null without a path.
[[nodiscard]] nlohmann::ordered_json path_quality_json(
    const std::optional<planning::PathQuality>& quality);

/// How human the hand looks along a path; nothing if the problem has no basis, or no path.
/// @param postures file to compare with; empty: those that the basis names, if any.
/// @throws InputError if the postures can't be read, or files are given and there's no basis.
[[nodiscard]] std::optional<planning::PathLikeness> hand_likeness(
    const planning::PlanningProblem& problem, const planning::Path& path,
    const std::filesystem::path& postures = {});

}  // namespace handway::tools
