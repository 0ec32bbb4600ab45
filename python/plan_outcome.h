#pragma once

#include "handway/planning/core/plan_result.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace handway::python {

/// What planning gave, with what it was asked.
struct PlanOutcome {
  planning::PlanResult result;
  std::string planner;
  std::uint64_t seed = 1;
  std::optional<std::size_t> goal_pose;  ///< Where the path ends, of goals as poses.
  int variables = 0;                     ///< Of the robot: the width of the path.
};

}  // namespace handway::python
