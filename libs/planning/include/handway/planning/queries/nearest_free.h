#pragma once

#include "handway/geometric/math/units.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>

namespace handway::planning {

/// Options of the search for the nearest free configuration.
struct NearestFreeOptions {
  /// Radius of the search, rad: Euclidean over all variables, a metre counting as a radian.
  double most_distance = geometric::radians(20.0);
  /// Wanted clearance of a configuration, m; less is accepted if no configuration has it, down to
  /// the least of a path's end (twice geometric::kLeastResolution).
  double clearance = geometric::metres(0.5);
  int most_checks = 20000;  ///< Largest number of checks.
  std::uint64_t seed = 1;
};

/// Result of a search for a free configuration.
struct NearestFree {
  std::optional<Configuration> q;  ///< Free and within limits; nothing if none was found.
  double distance = 0.0;           ///< From the search's centre, as in the options.
  int checks = 0;                  ///< Configurations checked.
};

/// Searches near `q` for a configuration that is free of collision and within limits: shells around
/// `q` that grow by a third, in each of them every variable alone, then random directions of the
/// hand, of the arm and of both. The result of the first successful shell is drawn back towards
/// `q`: along the straight line, joint by joint, and by random steps. The result is near, but not
/// proved to be the nearest. Same arguments, same bits.
/// @param q shape [variable_count]; of any values that are finite.
[[nodiscard]] HANDWAY_PLANNING_EXPORT NearestFree
find_nearest_free(const PlanningProblem& problem, const Configuration& q,
                  const NearestFreeOptions& options = {}, const std::stop_token& stop = {});

/// Describes the difference from `from` to `to`: "shoulder +1.2°, elbow -0.4°, 3 more joints". The
/// joints that move most come first. @param most joints to name, ≥ 1.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string describe_change(
    const geometric::RobotModel& model, const Configuration& from, const Configuration& to,
    int most = 2);

}  // namespace handway::planning
