#pragma once

#include "handway/planning/core/planner.h"

#include <string>

namespace handway::tools {

/// The JSON report of a run, keys as in docs/command-line.md.
[[nodiscard]] std::string plan_report(planning::Planner& planner,
                                      const planning::PlanRequest& request,
                                      const planning::PlanResult& result, double load_s);

}  // namespace handway::tools
