#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/timing/time_path.h"

#include <string>
#include <vector>

namespace handway::tools {

/// Configurations of a motion at equal points of its time, planned and as measured on emulated
/// devices.
struct EmulatedRun {
  double duration = 0.0;      ///< Planned, s.
  std::vector<double> times;  ///< s
  std::vector<planning::Configuration> planned;
  std::vector<planning::Configuration> measured;
  std::string fault;  ///< Reason why the motion did not reach its end; empty: it did.
};

/// Runs a motion on an emulated arm and hand, which follow it in real time.
/// @param points number of the times, from 0 to the end; ≥ 2.
/// @param motion cleared, from the problem's start.
/// @throws DeviceError if an emulated device can't be reached.
[[nodiscard]] EmulatedRun run_on_emulators(const planning::PlanningProblem& problem,
                                           const planning::Motion& motion, int points);

}  // namespace handway::tools
