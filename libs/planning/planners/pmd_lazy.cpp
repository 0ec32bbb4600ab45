#include "handway/planning/planners/pmd_lazy.h"

#include "handway/planning/core/planning_context.h"
#include "handway/planning/planners/search_parameters.h"
#include "planners/lazy_search.h"
#include "planners/smooth_result.h"

namespace handway::planning {

std::string PmdLazy::name() const { return "pmd-lazy"; }

std::string PmdLazy::description() const {
  return "Roadmap in the same regions that checks edges only where the shortest way leads";
}

PlannerCapabilities PmdLazy::capabilities() const {
  return {.uses_pmds = true, .needs_basis = true, .uses_threads = false, .deterministic = true};
}

std::vector<Parameter> PmdLazy::own_parameters() {
  std::vector<Parameter> list = {
      {"k", "Neighbours K", "", "Nearest nodes that a new node is joined to.", &settings_.k, 1,
       1000},
      {"batch", "Nodes at a time", "", "Nodes added when no way from start to goal is left.",
       &settings_.batch, 1, 100000},
      max_samples_parameter(settings_.max_samples),
      smoothing_checks_parameter(settings_.smoothing_checks),
  };
  list.push_back(corridor_parameter(settings_.region.corridor));
  append_region_parameters(list, settings_.region);
  return list;
}

void PmdLazy::do_plan(PlanningContext& context, PlanResult& result) {
  LazySearch search(context, settings_, context.request().seed);
  result.status = *search.advance({});
  if (result.solved()) {
    smooth_result(context, objective(), settings_.smoothing_checks, search.path(), result);
  }
}

}  // namespace handway::planning
