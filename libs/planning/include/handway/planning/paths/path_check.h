#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/collision/continuous/motion_bound.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::planning {

/// Result of checking a path.
struct PathCheckResult {
  std::vector<std::string> faults;  ///< A sentence each; empty: the path is valid.
  /// Warnings that are no faults, a sentence each: holding_warnings().
  std::vector<std::string> warnings;
  std::uint64_t configurations = 0;  ///< Checked ones.
  std::uint64_t collisions = 0;      ///< Number in collision or violating a constraint.
  double min_clearance = 0.0;        ///< m, at the checked configurations; 0 if one collides.
  std::string closest_pair;          ///< "A with B" at the smallest clearance.

  [[nodiscard]] bool valid() const { return faults.empty(); }
};

/// Describes a continuous joint that turns by more than half a turn from one waypoint to the next,
/// as in recordings that keep angles within ±π: "joint J turns by -356° at once, where 3.7° lead to
/// the same place"; empty if none does. Longer turns have waypoints between.
/// @param from, to shape [variable_count].
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string turn_fault(const geometric::RobotModel& model,
                                                             const Configuration& from,
                                                             const Configuration& to);

/// Checks a path independently of its source: joint limits, both ends against the
/// problem's, constraints, and collisions on the raw triangles (FclChecker) at
/// configurations so close that no point of the robot moves more than `resolution` (m) from
/// one to the next. Motions between these are certified as planners do, by
/// PathConflictSearch.
/// @throws PreparationStopped if `stop` is requested.
[[nodiscard]] HANDWAY_PLANNING_EXPORT PathCheckResult check_path(const PlanningProblem& problem,
                                                                 const Path& path,
                                                                 double resolution,
                                                                 const std::stop_token& stop = {});

/// The first place where a polyline of configurations is not free.
struct PathConflict {
  std::size_t waypoint = 0;  ///< The last waypoint before it, from 0.
  double share = 0.0;        ///< In [0, 1]: the place between there and the next waypoint.
  /// "A and B collide", "A comes closer than 0.05 mm to B", or "The motion violates constraint C".
  std::string text;
};

/// A sentence without its end, as PathConflict::text. @param pair or constraint; nothing: unknown.
/// @param resolution (m) that a pair does not keep; 0: it collides.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string conflict_text(
    const geometric::CollisionWorld& world, std::optional<int> pair, double resolution = 0.0);

/// Finds the first conflict of every configuration on a polyline, ends included, in the order in
/// which it is followed, as time_path() and preflight() do.
class HANDWAY_PLANNING_EXPORT PathConflictSearch {
 public:
  /// @param resolution (m) with which the path was planned: the motion may be any piece of it.
  explicit PathConflictSearch(const PlanningProblem& problem, double resolution = 5e-5);

  /// @param stop called now and then; once it returns true, the search ends without a conflict.
  /// @returns nothing if the polyline is free.
  [[nodiscard]] std::optional<PathConflict> run(std::span<const Configuration> waypoints,
                                                const std::function<bool()>& stop = {});
  /// Describes the conflict of one configuration, as PathConflict::text; empty if it is valid.
  [[nodiscard]] std::string conflict_at(const Configuration& q);

 private:
  std::unique_ptr<geometric::CollisionChecker> checker_;
  std::shared_ptr<const geometric::MotionBound> motion_;
  double resolution_;
};

}  // namespace handway::planning
