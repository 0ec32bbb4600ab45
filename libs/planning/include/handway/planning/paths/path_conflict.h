#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/collision/motion_bound.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace handway::planning {

/// The first place where a polyline of configurations is not free.
struct PathConflict {
  std::size_t waypoint = 0;  ///< The last waypoint up to there, from 0.
  double share = 0.0;        ///< In [0, 1]: how far it is from there to the next one.
  std::string bodies;        ///< "A and B"
  std::string what;          ///< "collide", or "come closer than 0.05 mm"
};

/// Looks for the first conflict of every configuration on a polyline, ends included, in the order
/// in which it is followed, as time_path() and preflight() do.
class HANDWAY_PLANNING_EXPORT PathConflictSearch {
 public:
  /// @param resolution (m) as EdgeChecker's.
  explicit PathConflictSearch(const PlanningProblem& problem, double resolution = 5e-5);

  /// @param stop asked now and then; once it says true there is no conflict to be found any more.
  /// @returns nothing if the polyline is free.
  [[nodiscard]] std::optional<PathConflict> run(std::span<const Configuration> waypoints,
                                                const std::function<bool()>& stop = {});
  /// The bodies that touch in one configuration: "A and B"; empty: none.
  [[nodiscard]] std::string bodies_touching(const Configuration& q);

 private:
  [[nodiscard]] std::string bodies(const std::optional<int>& pair) const;

  std::unique_ptr<geometric::CollisionChecker> checker_;
  std::shared_ptr<const geometric::MotionBound> motion_;
  double resolution_;
};

}  // namespace handway::planning
