#include "handway/planning/planners/rrt_connect.h"

#include "handway/planning/core/planning_context.h"
#include "handway/planning/paths/shortcut_smoothing.h"
#include "planners/bidirectional_search.h"
#include "planners/hand_arm_space.h"
#include "planners/phase_clock.h"

namespace handway::planning {

RrtConnect::RrtConnect(HandSpace space) : space_(space) {
  if (space == HandSpace::kAllJoints) {  // no regions to find short ways in
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
          .uses_threads = false,
          .deterministic = true};
}

std::vector<Parameter> RrtConnect::parameters() {
  std::vector<Parameter> list = {
      {"range", "Step length", "", "Longest step of a tree, in joints normalised to [0, 1].",
       &settings_.range, 1e-3, 10.0},
      {"refinements", "Shorter steps", "",
       "How often a step that is not free is tried again at a quarter of its length.",
       &settings_.refinements, 0, 5},
      {"max_samples", "Samples", "", "Samples drawn before the planner gives up.",
       &settings_.max_samples, 1, 100000000},
      {"smoothing_checks", "Checks to smooth", "",
       "Configurations checked to shorten the path once it is found. 0: it stays as it is.",
       &settings_.smoothing_checks, 0, 10000000},
  };
  if (space_ == HandSpace::kPrincipalDirections) {
    list.push_back({"corridor", "Corridor", "",
                    "Around the straight motion of the arm's joints, or of its tool.",
                    ChoiceValue{&settings_.corridor, {"joint", "cartesian"}}});
    list.push_back({"near_ends", "Samples near the ends", "",
                    "Share of samples drawn around start and goal.", &settings_.near_ends, 0.0,
                    1.0});
    list.push_back({"single_moves", "Moves of one part", "",
                    "Share of samples that move the arm alone or the hand alone.",
                    &settings_.single_moves, 0.0, 1.0});
    list.push_back({"rho_a", "Corridor half-width ρₐ", "",
                    "Half-width of the arm's corridor at the start, normalised.", &settings_.rho_a,
                    1e-5, 1.0});
    list.push_back({"rho_max", "Largest ρₐ", "", "The corridor does not grow beyond this.",
                    &settings_.rho_max, 1e-5, 1.0});
    list.push_back({"rho_growth", "Widening factor", "", "The corridor grows by this factor.",
                    &settings_.rho_growth, 1.0, 100.0});
    list.push_back({"samples_per_width", "Samples per width", "",
                    "Samples drawn before the corridor grows.", &settings_.samples_per_width, 1,
                    1000000});
  }
  return list;
}

void RrtConnect::do_plan(PlanningContext& context, PlanResult& result) {
  BidirectionalSearch search(context, settings_, space_, context.request().seed);
  result.status = *search.advance({});
  if (result.solved()) {
    const PhaseClock smoothing_time(result.smoothing_s);
    ShortcutSmoothing smoothing(context, hand_basis(context.problem(), space_),
                                static_cast<std::uint64_t>(settings_.smoothing_checks),
                                context.request().seed);
    result.path = smoothing.smooth(search.path());
  }
}

}  // namespace handway::planning
