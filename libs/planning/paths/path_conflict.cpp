#include "handway/planning/paths/path_conflict.h"

#include "handway/geometric/collision/continuous/continuous_collision_checker.h"

#include <fmt/format.h>

namespace handway::planning {

PathConflictSearch::PathConflictSearch(const PlanningProblem& problem, double resolution)
    : checker_(problem.checker->clone()), motion_(problem.motion), resolution_(resolution) {}

std::string conflict_text(const geometric::CollisionWorld& world, std::optional<int> pair,
                          double resolution) {
  const geometric::NamedPair two =
      pair ? geometric::named_pair(world, *pair, 0.0) : geometric::NamedPair{};
  if (pair && two.b.empty()) {
    return "The motion violates constraint " + two.a;
  }
  return (pair ? two.a + " and " + two.b : "Bodies") +
         (resolution > 0.0 ? fmt::format(" come closer than {:g} mm", 1e3 * resolution)
                           : " collide");
}

std::string PathConflictSearch::conflict_at(const Configuration& q) {
  const std::optional<int> pair = checker_->first_collision(q);
  return pair ? conflict_text(checker_->world(), pair) : std::string();
}

std::optional<PathConflict> PathConflictSearch::run(std::span<const Configuration> waypoints,
                                                    const std::function<bool()>& stop) {
  geometric::ContinuousCollisionChecker edges(*checker_, motion_, resolution_);
  const auto stopped = [&stop] { return stop && stop(); };
  if (stop) {
    edges.stop_when(stop);
  }
  if (!waypoints.empty()) {
    edges.set_ends({make_edge_end(*checker_, waypoints.front(), resolution_),
                    make_edge_end(*checker_, waypoints.back(), resolution_)});
  }
  for (std::size_t w = 0; w < waypoints.size() && !stopped(); ++w) {
    if (const auto pair = checker_->first_collision(waypoints[w])) {
      return PathConflict{w, 0.0, conflict_text(checker_->world(), pair)};
    }
    if (w == 0) {
      continue;
    }
    const geometric::EdgeResult edge = edges.check(waypoints[w - 1], waypoints[w]);
    if (!edge.free && !stopped()) {
      return PathConflict{w - 1, edge.at, conflict_text(checker_->world(), edge.pair, resolution_)};
    }
  }
  return std::nullopt;
}

}  // namespace handway::planning
