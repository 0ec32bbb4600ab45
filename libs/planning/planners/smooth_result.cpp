#include "planners/smooth_result.h"

#include "handway/planning/paths/path_optimizer.h"
#include "planners/phase_clock.h"

#include <algorithm>
#include <cmath>

namespace handway::planning {
namespace {

constexpr std::uint64_t kWaypoints = 16;  // that a number of checks is for
constexpr double kDistance = 0.01;        // of the hand from the subspace, that is worth a round

}  // namespace

void smooth_result(PlanningContext& context, const ObjectiveSettings& objective, int checks,
                   const Path& found, PlanResult& result, int most_rounds) {
  const PhaseClock smoothing_time(result.smoothing_s);
  const PlanningProblem& problem = context.problem();
  const ObjectiveWeights weights = objective.weights(problem);
  PathOptimizer optimizer(context, weights,
                          {problem.model().unwrapped(found.waypoints, problem.start)},
                          context.request().seed);
  const std::uint64_t parts = (found.waypoints.size() + kWaypoints - 1) / kWaypoints;
  const std::uint64_t round = parts * static_cast<std::uint64_t>(checks);
  const bool adapts = most_rounds > 1;
  optimizer.advance(adapts && weights == ObjectiveWeights{} ? round / 2 : round);
  if (adapts) {
    const double more = std::round(optimizer.avoidable_distance() / kDistance);
    optimizer.set_patience(PathOptimizer::kThorough);
    optimizer.advance(round * static_cast<std::uint64_t>(std::clamp(more, 0.0, most_rounds - 1.0)));
  }
  result.path = optimizer.path();
}

}  // namespace handway::planning
