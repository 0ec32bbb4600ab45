#include "handway/planning/core/planning_context.h"
#include "handway/planning/extensions/plugin.h"

#include <memory>
#include <string>
#include <vector>

namespace {

using handway::geometric::BoundParameter;
using handway::geometric::Configuration;
using handway::planning::Path;
using handway::planning::Planner;
using handway::planning::PlannerCapabilities;
using handway::planning::PlannerRegistry;
using handway::planning::PlanningContext;
using handway::planning::PlanningProblem;
using handway::planning::PlanResult;
using handway::planning::PlanStatus;
using handway::planning::Plugin;

/// Plans a straight line from start to goal, or one through the middle of the joints' ranges.
class StraightPlanner final : public Planner {
 public:
  std::string name() const override { return "straight"; }
  std::string description() const override { return "A straight line, or two"; }
  PlannerCapabilities capabilities() const override { return {}; }
  std::vector<BoundParameter> own_parameters() override {
    return {
        {"detour", "Detour", "", "Try the way by the middle of the joints' ranges too.", &detour_}};
  }

 protected:
  void do_plan(PlanningContext& context, PlanResult& result) override {
    const PlanningProblem& problem = context.problem();
    std::vector<Path> ways = {{{problem.start, problem.goal}}};
    if (detour_) {
      const Configuration middle = 0.5 * (problem.model().lower() + problem.model().upper());
      ways.push_back({{problem.start, middle, problem.goal}});
    }
    for (const Path& way : ways) {
      ++context.statistics().samples;
      if (is_free(context, way)) {
        result.status = PlanStatus::kSolved;
        result.path = way;
        return;
      }
    }
    result.status = PlanStatus::kSamplesSpent;
    result.reason = "Something is in the way.";
  }

 private:
  static bool is_free(PlanningContext& context, const Path& path) {
    for (std::size_t i = 0; i + 1 < path.waypoints.size(); ++i) {
      if (!context.validator().edge_free(path.waypoints[i], path.waypoints[i + 1])) {
        return false;
      }
    }
    return true;
  }

  bool detour_ = true;
};

}  // namespace

HANDWAY_PLUGIN({.name = "straight_planner",
                .version = PLUGIN_VERSION,
                .register_planners = [](PlannerRegistry& registry) {
                  registry.add("straight", [] { return std::make_unique<StraightPlanner>(); });
                }});
