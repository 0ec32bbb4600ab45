#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/planning/timing/rate_limits.h"
#include "handway/planning/timing/trajectory.h"
#include "handway/planning/timing/trajectory_check.h"

#include <string>
#include <vector>

namespace handway::planning {

struct PreflightOptions {
  RateLimits limits;
  /// Where the robot is, as measured; of size 0: it is not compared.
  Configuration measured_start;
  double start_tolerance = 1e-3;  ///< rad or m
  double resolution = 5e-5;       ///< m, as EdgeChecker's
};

/// Largest share that a motion takes of a limit, and where.
struct LimitShare {
  std::string joint;
  double time = 0.0;   ///< s
  double share = 0.0;  ///< 1: at the limit.
};

/// What is known about a trajectory before it runs.
struct PreflightReport {
  std::vector<TrajectoryFault> faults;  ///< Empty: cleared to run.
  std::size_t points = 0;
  double duration = 0.0;  ///< s
  LimitShare velocity;
  LimitShare acceleration;
  double min_clearance_mm = 0.0;      ///< At the points; more than 50 mm is not distinguished.
  double min_clearance_time = 0.0;    ///< s
  std::string closest_pair;           ///< "A with B"
  std::vector<AssumedLimit> assumed;  ///< Limits that it was checked against and no file has.

  [[nodiscard]] bool cleared() const { return faults.empty(); }
};

/// Checks everything that can be known without the robot: check_trajectory(), the start
/// against what was measured and the straight way from there, and collisions for every
/// configuration between the points (they are followed in straight lines), with the clearance along
/// time. A trajectory that fails check_trajectory() is not looked at further.
[[nodiscard]] HANDWAY_PLANNING_EXPORT PreflightReport preflight(const PlanningProblem& problem,
                                                                const Trajectory& trajectory,
                                                                const PreflightOptions& options);

/// For a person, a line each.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string to_text(const PreflightReport& report);

/// A JSON object: `cleared`, `faults` (`joint`, `time_s`, `value`, `text`), `points`,
/// `duration_s`, `velocity` and `acceleration` (`joint`, `time_s`, `share`),
/// `min_clearance_mm`, `min_clearance_time_s`, `closest_pair`, `assumed_limits` (`joint`, `limit`:
/// rate_name(), `value`). What is no finite number is null.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string to_json(const PreflightReport& report);

}  // namespace handway::planning
