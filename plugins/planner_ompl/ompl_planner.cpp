#include "ompl_planner.h"

#include "handway/planning/core/planning_context.h"
#include "handway/planning/paths/roadmap_smoothing.h"
#include "search.h"

#include <ompl/util/Console.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace handway::planner_ompl {
namespace {

using planning::Parameter;

class DebugLog final : public ompl::msg::OutputHandler {
 public:
  void log(const std::string& text, ompl::msg::LogLevel /*level*/, const char* /*file*/,
           int /*line*/) override {
    spdlog::debug("OMPL: {}", text);
  }
};

}  // namespace

OmplPlanner::OmplPlanner(const Method& method) : method_(method) {
  for (const MethodSetting& setting : method.settings) {
    values_.push_back(setting.initial);
  }
}

std::vector<Parameter> OmplPlanner::parameters() {
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
  list.push_back({"max_samples", "Samples", "", "Samples drawn before the planner gives up.",
                  &max_samples_, 1, 100000000});
  return list;
}

void OmplPlanner::do_plan(planning::PlanningContext& context, planning::PlanResult& result) {
  std::vector<Parameter> settings = parameters();
  settings.pop_back();  // the sample budget is not OMPL's
  Search search(context, method_, settings, max_samples_);
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
  for (const Method& method : methods()) {
    registry.add(method.name, [&method] { return std::make_unique<OmplPlanner>(method); });
  }
}

}  // namespace handway::planner_ompl
