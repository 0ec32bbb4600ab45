#include "planners/smooth_result.h"

#include "handway/planning/paths/shortcut_smoothing.h"
#include "planners/phase_clock.h"

namespace handway::planning {

void smooth_result(PlanningContext& context, const sampling::PmdBasis& basis, int checks,
                   const Path& found, PlanResult& result) {
  const PhaseClock smoothing_time(result.smoothing_s);
  ShortcutSmoothing smoothing(context, basis, static_cast<std::uint64_t>(checks),
                              context.request().seed);
  result.path = smoothing.smooth(found);
}

}  // namespace handway::planning
