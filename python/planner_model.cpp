#include "planner_model.h"

#include "bindings.h"
#include "keyword_settings.h"

#include <functional>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace py = pybind11;

namespace handway::python {

const planning::PluginManager& plugin_manager() {
  static const planning::PluginManager& loaded = [] {
    auto* made = new planning::PluginManager;
    made->load_plugins(planning::plugin_directory());
    return std::ref(*made);
  }();
  return loaded;
}

namespace {

using geometric::Parameter;
using planning::PlannerRegistry;

}  // namespace

py::object value_of(const Parameter& parameter) {
  return std::visit(
      [&](const auto& value) -> py::object {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, geometric::Choice>) {
          return py::str(to_text(parameter));
        } else {
          return py::cast(value);
        }
      },
      parameter.value);
}

PlannerModel::PlannerModel(std::unique_ptr<planning::Planner> planner)
    : planner_(std::move(planner)) {}

void PlannerModel::need_idle() const {
  if (runs_) {
    throw std::runtime_error("planner " + planner_->name() +
                             " is running: wait for it, or make another");
  }
}

py::object PlannerModel::get(const std::string& key) const {
  return value_of(find_parameter(parameters(), key));
}

void PlannerModel::set(const std::string& key, const py::object& value) {
  need_idle();
  planner_->set_parameter(key, setting_text(value));
}

PlanOutcome PlannerModel::plan(const planning::PlanningProblem& problem,
                               const planning::PlanRequest& request) {
  PlanOutcome outcome;
  outcome.planner = planner_->name();
  outcome.seed = request.seed;
  outcome.variables = problem.model().variable_count();
  run([&](const std::stop_token& stop) {
    outcome.result = planner_->plan(problem, request, stop);
  });
  if (outcome.result.goal) {
    outcome.goal_pose = problem.goals[*outcome.result.goal].pose;
  }
  return outcome;
}

planning::TaskPlan PlannerModel::plan_task(const SceneModel& scene, const planning::Task& task,
                                           const planning::TaskOptions& options) {
  planning::TaskPlan plan;
  run([&](const std::stop_token& stop) {
    plan = planning::plan_task({scene.problem().scene, scene.problem().basis}, task, *planner_,
                               options, stop);
  });
  return plan;
}

void PlannerModel::run(const std::function<void(const std::stop_token& stop)>& work) {
  need_idle();
  runs_ = true;
  try {
    run_interruptible(work);
  } catch (...) {
    runs_ = false;
    throw;
  }
  runs_ = false;
}

std::unique_ptr<PlannerModel> make_planner(const std::string& name) {
  const PlannerRegistry& registry = plugin_manager().planners();
  return std::make_unique<PlannerModel>(
      registry.create(name.empty() ? registry.names().front() : name));
}

std::unique_ptr<PlannerModel> make_scene_planner(const SceneModel& scene, const std::string& name) {
  const geometric::PlannerRequest& choice = scene.scene().planner;
  std::unique_ptr<PlannerModel> planner = make_planner(name.empty() ? choice.name : name);
  if (choice.name.empty() || planner->planner().name() == choice.name) {
    for (const auto& [key, text] : choice.settings) {
      planner->set(key, py::str(text));
    }
  }
  return planner;
}

}  // namespace handway::python
