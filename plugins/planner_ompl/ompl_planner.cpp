#include "ompl_planner.h"

#include "handway/planning/core/planning_context.h"
#include "handway/planning/paths/roadmap_smoothing.h"
#include "joint_cube.h"

#include <fmt/format.h>
#include <ompl/util/Console.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace handway::planner_ompl {
namespace {

using planning::HandSpace;
using planning::Parameter;

void append_region_parameters(std::vector<Parameter>& list, ControlRegion& region) {
  planning::TargetRegion& target = region.target;
  list.push_back({"max_pmds", "Principal directions", "",
                  "Most principal motion directions that are used together.", &region.max_pmds, 1,
                  13});
  list.push_back({"near_ends", "Samples near the ends", "",
                  "Share of samples drawn around start and goal.", &target.near_ends, 0.0, 1.0});
  list.push_back({"rho_a", "Corridor half-width ρₐ", "",
                  "Half-width of the arm's corridor at the start, normalised.", &target.rho_a, 1e-5,
                  1.0});
  list.push_back({"rho_max", "Largest ρₐ", "", "The corridor does not grow beyond this.",
                  &target.rho_max, 1e-5, 1.0});
  list.push_back({"rho_growth", "Widening factor", "", "The corridor grows by this factor.",
                  &target.rho_growth, 1.0, 100.0});
  list.push_back({"samples_per_width", "Samples per width", "",
                  "Samples drawn before the corridor grows.", &target.samples_per_width, 1,
                  1000000});
}

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

std::vector<Parameter> OmplPlanner::method_parameters() {
  std::vector<Parameter> list;
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

std::vector<Parameter> OmplPlanner::own_parameters() {
  std::vector<Parameter> list = method_parameters();
  list.push_back({"max_samples", "Samples", "", "Samples drawn before the planner gives up.",
                  &budget_.all, 1, 100000000});
  if (method_.traits.improves) {
    list.push_back({"improvement_samples", "Samples to improve", "",
                    "Samples drawn after the first path to find a shorter one. 0: the first is "
                    "taken.",
                    &budget_.improvement, 0, 100000000});
  }
  if (space_ == HandSpace::kPrincipalDirections) {
    append_region_parameters(list, region_);
  }
  return list;
}

std::unique_ptr<StateMap> OmplPlanner::make_map(const planning::PlanningProblem& problem) const {
  if (space_ == HandSpace::kAllJoints) {
    return std::make_unique<JointCube>(problem);
  }
  return std::make_unique<ControlBox>(problem, region_);
}

void OmplPlanner::do_plan(planning::PlanningContext& context, planning::PlanResult& result) {
  Search search(context, method_, make_map(context.problem()), method_parameters(), budget_);
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
