#include "handway/planning/planners/pmd_lazy.h"

#include "handway/planning/core/planning_context.h"
#include "handway/planning/paths/shortcut_smoothing.h"
#include "planners/lazy_search.h"
#include "planners/phase_clock.h"

namespace handway::planning {

std::string PmdLazy::name() const { return "pmd-lazy"; }

std::string PmdLazy::description() const {
  return "Roadmap in the same regions that checks edges only where the shortest way leads";
}

PlannerCapabilities PmdLazy::capabilities() const {
  return {.uses_pmds = true, .uses_threads = false, .deterministic = true};
}

std::vector<Parameter> PmdLazy::parameters() {
  RrtConnectSettings& region = settings_.region;
  return {
      {"k", "Neighbours K", "", "Nearest nodes that a new node is joined to.", &settings_.k, 1,
       1000},
      {"batch", "Nodes at a time", "", "Nodes added when no way from start to goal is left.",
       &settings_.batch, 1, 100000},
      {"max_samples", "Samples", "", "Samples drawn before the planner gives up.",
       &settings_.max_samples, 1, 100000000},
      {"smoothing_checks", "Checks to smooth", "",
       "Configurations checked to shorten the path once it is found. 0: it stays as it is.",
       &settings_.smoothing_checks, 0, 10000000},
      {"corridor", "Corridor", "",
       "Around the straight motion of the arm's joints, or of its tool.",
       ChoiceValue{&region.corridor, {"joint", "cartesian"}}},
      {"near_ends", "Samples near the ends", "", "Share of samples drawn around start and goal.",
       &region.near_ends, 0.0, 1.0},
      {"rho_a", "Corridor half-width ρₐ", "",
       "Half-width of the arm's corridor at the start, normalised.", &region.rho_a, 1e-5, 1.0},
      {"rho_max", "Largest ρₐ", "", "The corridor does not grow beyond this.", &region.rho_max,
       1e-5, 1.0},
      {"rho_growth", "Widening factor", "", "The corridor grows by this factor.",
       &region.rho_growth, 1.0, 100.0},
      {"samples_per_width", "Samples per width", "", "Samples drawn before the corridor grows.",
       &region.samples_per_width, 1, 1000000},
  };
}

void PmdLazy::do_plan(PlanningContext& context, PlanResult& result) {
  LazySearch search(context, settings_, context.request().seed);
  result.status = *search.advance({});
  if (result.solved()) {
    const PhaseClock smoothing_time(result.smoothing_s);
    ShortcutSmoothing smoothing(context, *context.problem().basis,
                                static_cast<std::uint64_t>(settings_.smoothing_checks),
                                context.request().seed);
    result.path = smoothing.smooth(search.path());
  }
}

}  // namespace handway::planning
