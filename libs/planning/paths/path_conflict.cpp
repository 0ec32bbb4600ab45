#include "handway/planning/paths/path_conflict.h"

#include "handway/geometric/collision/edge_checker.h"

#include <fmt/format.h>

namespace handway::planning {

PathConflictSearch::PathConflictSearch(const PlanningProblem& problem, double resolution)
    : checker_(problem.checker->clone()), motion_(problem.motion), resolution_(resolution) {}

std::string PathConflictSearch::bodies(const std::optional<int>& pair) const {
  if (!pair) {
    return "Bodies";
  }
  const geometric::NamedPair two = geometric::named_pair(checker_->world(), *pair, 0.0);
  return two.a + " and " + two.b;
}

std::string PathConflictSearch::bodies_touching(const Configuration& q) {
  const std::optional<int> pair = checker_->first_collision(q);
  return pair ? bodies(pair) : std::string();
}

std::optional<PathConflict> PathConflictSearch::run(std::span<const Configuration> waypoints,
                                                    const std::function<bool()>& stop) {
  geometric::EdgeChecker edges(*checker_, motion_, resolution_);
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
      return PathConflict{w, 0.0, bodies(pair), "collide"};
    }
    if (w == 0) {
      continue;
    }
    const geometric::EdgeResult edge = edges.check(waypoints[w - 1], waypoints[w]);
    if (!edge.free && !stopped()) {
      return PathConflict{w - 1, edge.at, bodies(edge.pair),
                          fmt::format("come closer than {:g} mm", 1e3 * resolution_)};
    }
  }
  return std::nullopt;
}

}  // namespace handway::planning
