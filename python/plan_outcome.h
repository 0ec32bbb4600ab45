#pragma once

#include "handway/planning/core/plan_result.h"

#include <cstdint>
#include <string>

namespace handway::python {

/// What planning gave, with what it was asked.
struct PlanOutcome {
  planning::PlanResult result;
  std::string planner;
  std::uint64_t seed = 1;
  int variables = 0;  ///< Of the robot: the width of the path.
};

}  // namespace handway::python
