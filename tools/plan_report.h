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
/// @param likeness of the path's hand; nothing without a path or a basis to compare with.
/// @param quality of the path; nothing without a path.
[[nodiscard]] std::string plan_report(planning::Planner& planner,
                                      const planning::PlanningProblem& problem,
                                      const planning::PlanRequest& request,
                                      const planning::PlanResult& result, double load_s,
                                      const std::optional<planning::PathLikeness>& likeness,
                                      const std::optional<planning::PathQuality>& quality);

/// Quality measures of a path, keys as `objective` in docs/command-line.md; null without a path.
[[nodiscard]] nlohmann::ordered_json path_quality_json(
    const std::optional<planning::PathQuality>& quality);

/// Likeness of the hand along a path to a human hand; nothing without a basis or a path.
/// @param postures file to compare with; empty: those that the basis names, if any.
/// @throws InputError if the postures can't be read, or files are given and there's no basis.
[[nodiscard]] std::optional<planning::PathLikeness> hand_likeness(
    const planning::PlanningProblem& problem, const planning::Path& path,
    const std::filesystem::path& postures = {});

}  // namespace handway::tools
