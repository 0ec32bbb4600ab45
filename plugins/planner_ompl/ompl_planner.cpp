#include "ompl_planner.h"

#include "handway/planning/core/planning_context.h"
#include "handway/planning/paths/roadmap_smoothing.h"
#include "handway/planning/spaces/target_sampler.h"

#include <fmt/format.h>
#include <ompl/util/Console.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

namespace handway::planner_ompl {
namespace {

using planning::BoundParameter;
using planning::HandSpace;
using planning::Parameter;

class DebugLog final : public ompl::msg::OutputHandler {
 public:
  void log(const std::string& text, ompl::msg::LogLevel /*level*/, const char* /*file*/,
           int /*line*/) override {
    spdlog::debug("OMPL: {}", text);
  }
};

}  // namespace

OmplPlanner::OmplPlanner(const Method& method, planning::HandSpace space)
    : method_(method), space_(space) {
  for (const MethodSetting& setting : method.settings) {
    values_.push_back(setting.initial);
  }
}

std::string OmplPlanner::name() const {
  return (space_ == HandSpace::kAllJoints ? "ompl-" : "ompl-pmd-") + method_.key;
}

std::string OmplPlanner::description() const {
  return fmt::format("OMPL's {} over {}: {}", method_.name,
                     space_ == HandSpace::kAllJoints
                         ? "all joints"
                         : "the arm's corridor and principal directions",
                     method_.summary);
}

planning::PlannerCapabilities OmplPlanner::capabilities() const {
  const bool in_controls = space_ == HandSpace::kPrincipalDirections;
  return {.uses_pmds = in_controls, .needs_basis = in_controls};
}

std::vector<BoundParameter> OmplPlanner::method_parameters() {
  std::vector<BoundParameter> list;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const MethodSetting& setting = method_.settings[i];
    std::visit(
        [&](auto& value) {
          list.push_back(
              {setting.key, setting.label, "", setting.help, &value, setting.lower, setting.upper});
        },
        values_[i]);
  }
  return list;
}

std::vector<BoundParameter> OmplPlanner::own_parameters() {
  std::vector<BoundParameter> list = method_parameters();
  list.push_back({"max_samples", "Samples", "", "Samples drawn before the planner gives up.",
                  &budget_.all, 1, 100000000});
  if (method_.traits.improves) {
    list.push_back({"improvement_samples", "Samples to improve", "",
                    "Samples drawn after the first path to find a shorter one. 0: the first is "
                    "taken.",
                    &budget_.improvement, 0, 100000000});
  }
  if (space_ == HandSpace::kPrincipalDirections) {
    list.push_back({"max_pmds", "Principal directions", "",
                    "Most principal motion directions that are used together.", &region_.max_pmds,
                    1, 13});
    planning::append_region_parameters(list, region_);
  }
  return list;
}

void OmplPlanner::do_plan(planning::PlanningContext& context, planning::PlanResult& result) {
  const planning::PlanningProblem& problem = context.problem();
  std::unique_ptr<planning::StateSpace> space;
  if (space_ == HandSpace::kAllJoints) {
    space = planning::make_corridor_space(problem, planning::CorridorForm::kJoint);
  } else {
    space = planning::make_control_space(problem, region_.max_pmds, region_.rho_max);
  }
  std::vector<Parameter> settings;
  std::ranges::transform(method_parameters(), std::back_inserter(settings), planning::value_of);
  Search search(context, method_, std::make_unique<StateMap>(std::move(space)), settings, budget_,
                region_, space_);
  search.run(result);
  if (result.solved()) {
    const double begin = context.elapsed_s();
    result.path = planning::smooth_by_roadmap(context, result.path);
    result.smoothing_s = context.elapsed_s() - begin;
  }
}

void register_planners(planning::PlannerRegistry& registry) {
  static DebugLog log;
  ompl::msg::useOutputHandler(&log);
  for (const HandSpace space : {HandSpace::kAllJoints, HandSpace::kPrincipalDirections}) {
    for (const Method& method : methods()) {
      registry.add(OmplPlanner(method, space).name(),
                   [&method, space] { return std::make_unique<OmplPlanner>(method, space); });
    }
  }
}

}  // namespace handway::planner_ompl
