#include "planners/smooth_result.h"

#include "handway/planning/paths/path_optimizer.h"
#include "planners/phase_clock.h"

namespace handway::planning {
namespace {

constexpr std::uint64_t kWaypoints = 16;  // that a number of checks is for

}  // namespace

void smooth_result(PlanningContext& context, const ObjectiveSettings& objective, int checks,
                   const Path& found, PlanResult& result) {
  const PhaseClock smoothing_time(result.smoothing_s);
  PathOptimizer optimizer(context, objective.weights(context.problem()), found,
                          context.request().seed);
  const std::uint64_t parts = (found.waypoints.size() + kWaypoints - 1) / kWaypoints;
  optimizer.advance(parts * static_cast<std::uint64_t>(checks));
  result.path = optimizer.path();
}

}  // namespace handway::planning
