#pragma once

#include "handway/planning/core/objective.h"
#include "handway/planning/core/planner.h"
#include "handway/planning/queries/human_likeness.h"

#include <optional>
#include <string>

namespace handway::tools {

/// The JSON report of a run, keys as in docs/command-line.md.
/// @param likeness of the path's hand; nothing: there is no path, or no basis to compare with.
/// @param quality of the path; nothing: there is none.
[[nodiscard]] std::string plan_report(planning::Planner& planner,
                                      const planning::PlanRequest& request,
                                      const planning::PlanResult& result, double load_s,
                                      const std::optional<planning::PathLikeness>& likeness,
                                      const std::optional<planning::PathQuality>& quality);

}  // namespace handway::tools
