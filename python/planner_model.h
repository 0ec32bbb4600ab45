#pragma once

#include "handway/planning/core/plan_result.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/tasks/task.h"
#include "scene_model.h"

#include <pybind11/pybind11.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::python {

/// The planners and file formats of this process: built-in ones and those of the plugins, from
/// $HANDWAY_PLUGIN_DIR, or handway-plugins beside the libraries. Loaded on first access; kept to
/// the end, because Python may hold their objects until then.
[[nodiscard]] const planning::PluginManager& plugin_manager();

/// Result of planning, with the request.
struct PlanOutcome {
  planning::PlanResult result;
  std::string planner;
  std::uint64_t seed = 1;
  std::optional<std::size_t> goal_pose;  ///< Index of the goal pose that the path reaches.
  int variables = 0;                     ///< Number of the robot's variables: the path's width.
};

/// A planner for Python: for one run at a time, its parameters by key.
class PlannerModel {
 public:
  explicit PlannerModel(std::unique_ptr<planning::Planner> planner);

  [[nodiscard]] const planning::Planner& planner() const { return *planner_; }

  /// The present settings, bound to this object.
  [[nodiscard]] std::vector<geometric::Parameter> parameters() const {
    return planner_->parameters();
  }

  /// A bool, int, float or str, by the parameter's kind.
  /// @throws InputError naming the valid keys.
  [[nodiscard]] pybind11::object get(const std::string& key) const;

  /// @throws InputError if the key is unknown or the value invalid for the parameter;
  /// std::runtime_error while the planner runs.
  void set(const std::string& key, const pybind11::object& value);

  /// Plans without the interpreter's lock; Ctrl-C stops it.
  /// @throws std::runtime_error while the planner runs already.
  [[nodiscard]] PlanOutcome plan(const planning::PlanningProblem& problem,
                                 const planning::PlanRequest& request);

  /// Plans a task without the interpreter's lock; Ctrl-C stops it.
  /// @throws std::runtime_error while the planner runs already; InputError as
  /// planning::plan_task().
  [[nodiscard]] planning::TaskPlan plan_task(const SceneModel& scene, const planning::Task& task,
                                             const planning::TaskOptions& options);

 private:
  void need_idle() const;
  /// Runs `work` while no other one may run.
  void run(const std::function<void(const std::stop_token& stop)>& work);

  std::unique_ptr<planning::Planner> planner_;
  std::atomic<bool> runs_ = false;
};

/// The planner called `name`, or the default one, with its own defaults.
/// @throws InputError naming the valid planners.
[[nodiscard]] std::unique_ptr<PlannerModel> make_planner(const std::string& name);

/// The planner that the scene requests with its settings, or that called `name`, with the scene's
/// settings if they are meant for it. @throws InputError if the scene's settings are invalid.
[[nodiscard]] std::unique_ptr<PlannerModel> make_scene_planner(const SceneModel& scene,
                                                               const std::string& name);

/// A parameter's value as a Python object.
[[nodiscard]] pybind11::object value_of(const geometric::Parameter& parameter);

}  // namespace handway::python
