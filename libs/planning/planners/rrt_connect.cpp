#include "handway/planning/planners/rrt_connect.h"

#include "handway/planning/core/planning_context.h"
#include "handway/planning/paths/path_optimizer.h"
#include "handway/planning/spaces/target_sampler.h"
#include "planners/bidirectional_search.h"

namespace handway::planning {

RrtConnect::RrtConnect(HandSpace space) : space_(space) {
  if (space == HandSpace::kAllJoints) {  // no regions to find short paths in
    settings_.range = 0.2;
    settings_.refinements = 2;
  }
}

std::string RrtConnect::name() const {
  return space_ == HandSpace::kPrincipalDirections ? "pmd-rrt-connect" : "rrt-connect";
}

std::string RrtConnect::description() const {
  return space_ == HandSpace::kPrincipalDirections
             ? "Two trees in a widening corridor of the arm and the hand's principal directions"
             : "Two trees over all joints";
}

PlannerCapabilities RrtConnect::capabilities() const {
  return {.uses_pmds = space_ == HandSpace::kPrincipalDirections,
          .needs_basis = space_ == HandSpace::kPrincipalDirections,
          .uses_threads = false,
          .deterministic = true};
}

std::vector<BoundParameter> RrtConnect::own_parameters() {
  std::vector<BoundParameter> list = {
      {"range", "Step length", "", "Longest step of a tree, in joints normalised to [0, 1].",
       &settings_.range, 1e-3, 10.0},
      {"refinements", "Shorter steps", "",
       "How often a step that is not free is tried again at a quarter of its length.",
       &settings_.refinements, 0, 5},
      max_samples_parameter(settings_.max_samples),
      smoothing_checks_parameter(settings_.smoothing_checks),
  };
  if (space_ == HandSpace::kPrincipalDirections) {
    list.push_back({"single_moves", "Moves of one part", "",
                    "Share of samples that move the arm alone or the hand alone.",
                    &settings_.single_moves, 0.0, 1.0});
    list.push_back({"expansions", "Expansions", "",
                    "Share of steps from a node that few were tried from to somewhere near it: to "
                    "get out of tight places.",
                    &settings_.expansions, 0.0, 1.0});
    list.push_back(corridor_parameter(settings_.region.corridor));
    append_region_parameters(list, settings_.region);
  }
  return list;
}

void RrtConnect::do_plan(PlanningContext& context, PlanResult& result) {
  BidirectionalSearch search(context, settings_, space_, context.request().seed);
  result.status = *search.advance({});
  if (result.solved()) {
    smooth_result(context, objective(), settings_.smoothing_checks, search.path(), result);
  }
}

}  // namespace handway::planning
