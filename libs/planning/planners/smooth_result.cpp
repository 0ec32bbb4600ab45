#include "planners/smooth_result.h"

#include "handway/planning/paths/path_optimizer.h"
#include "planners/phase_clock.h"

namespace handway::planning {

void smooth_result(PlanningContext& context, const ObjectiveSettings& objective, int checks,
                   const Path& found, PlanResult& result) {
  const PhaseClock smoothing_time(result.smoothing_s);
  PathOptimizer optimizer(context, objective.weights(context.problem()), found,
                          context.request().seed);
  optimizer.advance(static_cast<std::uint64_t>(checks));
  result.path = optimizer.path();
}

}  // namespace handway::planning
