#include "arrays.h"
#include "bindings.h"
#include "handway/geometric/formats/program_steps.h"
#include "handway/geometric/io/input_error.h"
#include "handway/planning/tasks/task.h"
#include "handway/planning/tasks/task_file.h"
#include "keyword_settings.h"
#include "planner_model.h"
#include "scene_questions.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace py = pybind11;

namespace handway::python {
namespace {

using geometric::InputError;
using planning::TaskPlan;
using planning::TaskStage;

// A length in m from a dict; `otherwise` if the dict lacks it.
double length_from(const py::dict& step, const char* key, double otherwise) {
  if (!step.contains(key)) {
    return otherwise;
  }
  const double length = step[key].cast<double>();
  constexpr double kMost = geometric::kLongestStraightMotion;
  if (!(length >= 0.0 && length <= kMost)) {
    throw InputError({"steps", key, fmt::format("{}", length),
                      fmt::format("a length from 0 to {:g} m", kMost), ""});
  }
  return length;
}

void allow_keys(const py::dict& step, const std::set<std::string>& known) {
  for (const auto& [key, value] : step) {
    const std::string name = py::str(key);
    if (!known.contains(name)) {
      throw InputError({"steps", "", "the key \"" + name + "\"",
                        fmt::format("one of: {}", fmt::join(known, ", ")), ""});
    }
  }
}

planning::PlaceStep place_from(const py::dict& step) {
  allow_keys(step, {"place", "lower", "retreat"});
  planning::PlaceStep place;
  if (py::isinstance<py::str>(step["place"])) {
    place.support = step["place"].cast<std::string>();
  } else {
    place.pose = pose_from(step["place"].cast<Array>(), "place");
  }
  place.lower = length_from(step, "lower", place.lower);
  place.retreat = length_from(step, "retreat", place.retreat);
  return place;
}

planning::TaskStep step_from(const SceneModel& scene, const py::dict& step) {
  if (step.contains("pick")) {
    allow_keys(step, {"pick", "approach", "lift"});
    planning::PickStep pick{step["pick"].cast<std::string>()};
    pick.approach = length_from(step, "approach", pick.approach);
    pick.lift = length_from(step, "lift", pick.lift);
    return pick;
  }
  if (step.contains("place")) {
    return place_from(step);
  }
  allow_keys(step, {"move"});
  if (!step.contains("move")) {
    throw InputError({"steps", "", "an empty dict", "a dict with the key pick, place or move", ""});
  }
  if (py::isinstance<py::str>(step["move"])) {
    return planning::move_to_posture(scene.scene(), step["move"].cast<std::string>(), "steps");
  }
  return planning::MoveStep{
      vector_from(step["move"].cast<Array>(), scene.robot().variable_count(), "move"),
      "a configuration"};
}

planning::Task task_of(const SceneModel& scene, const py::object& steps) {
  if (py::isinstance<py::str>(steps)) {
    return planning::program_task(scene.scene(), steps.cast<std::string>());
  }
  planning::Task task;
  for (const py::dict& step : steps.cast<std::vector<py::dict>>()) {
    task.push_back(step_from(scene, step));
  }
  return task;
}

TaskPlan plan_task(PlannerModel& planner, const SceneModel& scene, const py::object& steps,
                   std::uint64_t seed, int threads, const py::kwargs& settings) {
  const planning::Task task = task_of(scene, steps);
  if (threads < 1 || threads > 1024) {
    throw InputError({"threads", "", std::to_string(threads), "a number from 1 to 1024", ""});
  }
  planning::TaskOptions options;
  options.seed = seed;
  options.threads = threads;
  set_from_keywords(parameters_of(options), settings);
  return planner.plan_task(scene, task, options);
}

py::list trials_of(const TaskPlan& plan) {
  py::list trials;
  for (const planning::StageTrials& one : plan.trials) {
    py::dict trial;
    trial["step"] = one.step;
    trial["kind"] = to_string(one.kind);
    trial["tried"] = one.tried;
    trial["failed"] = one.failed;
    trial["reason"] = one.reason;
    trial["q"] = one.q.size() > 0 ? py::object(to_array(one.q)) : py::none();
    trials.append(trial);
  }
  return trials;
}

std::unique_ptr<SceneModel> scene_of(const TaskStage& stage) {
  const py::gil_scoped_release release;
  return std::make_unique<SceneModel>(stage.state.scene, stage.state.basis);
}

void bind_stage(py::module_& module) {
  py::class_<TaskStage>(module, "TaskStage", "Stage of a planned task: a path in its own scene.")
      .def_property_readonly(
          "kind", [](const TaskStage& stage) { return to_string(stage.kind); },
          "Kind: approach, reach, close, lift, carry, lower, open, retreat or move.")
      .def_readonly("step", &TaskStage::step, "Index of the step that it belongs to.")
      .def_property_readonly("scene", &scene_of,
                             "Scene of the stage: what the hand carries is attached, and the\n"
                             "contacts that it allows are in its allowed collisions.")
      .def_property_readonly(
          "path",
          [](const TaskStage& stage) {
            return to_array(stage.path.waypoints, stage.path.waypoints.front().size());
          },
          "Waypoints [n, variables].")
      .def_readonly("carried", &TaskStage::carried, "Object in the hand; empty: none.")
      .def_readonly("deviation", &TaskStage::deviation,
                    "Bound of the palm's distance from the straight line, m; 0 of other stages.")
      .def_property_readonly(
          "squeezed",
          [](const TaskStage& stage) {
            return stage.squeezed.size() > 0 ? py::object(to_array(stage.squeezed)) : py::none();
          },
          "Joint targets [variables] that hold the object, of the stage close; else None.")
      .def("__repr__", [](const TaskStage& stage) {
        return fmt::format("<handway.TaskStage {}, {} waypoints>", to_string(stage.kind),
                           stage.path.waypoints.size());
      });
}

}  // namespace

void bind_tasks(py::module_& module) {
  bind_stage(module);
  py::class_<TaskPlan>(module, "TaskPlan", "Result of planning a task.")
      .def_readonly("solved", &TaskPlan::solved, "True if every step has its stages.")
      .def_readonly("reason", &TaskPlan::reason, "Why it is not solved, one sentence.")
      .def_readonly("stages", &TaskPlan::stages, "Stages in their order, as TaskStage.")
      .def_property_readonly("trials", &trials_of,
                             "Candidates of each stage: dicts with step, kind, tried, failed,\n"
                             "reason of the first failure, and q [variables] that shows it.")
      .def_readonly("time_s", &TaskPlan::time_s, "Time of planning, s.")
      .def("__repr__", [](const TaskPlan& plan) {
        return plan.solved ? fmt::format("<handway.TaskPlan of {} stages>", plan.stages.size())
                           : std::string("<handway.TaskPlan, not solved>");
      });
  py::object planner = module.attr("Planner");
  planner.attr("plan_task") = py::cpp_function(
      &plan_task, py::is_method(planner), py::name("plan_task"), py::arg("scene"), py::arg("steps"),
      py::kw_only(), py::arg("seed") = 1, py::arg("threads") = 1,
      "Plans a task: picks objects, carries them and places them.\n\n"
      "scene: the scene in which the task begins, at its start.\n"
      "steps: dicts, each with one of the keys pick (the name of an object; with approach and\n"
      "lift, m), place (the name of the object on which it is placed, or its pose [4, 4] in the\n"
      "world; with lower and retreat, m) and move (\"start\", the name of a posture, or a\n"
      "configuration [variables]); or the name of a program of the scene, \"\" for its only one.\n"
      "seed: seed of all random choices. threads: their number, which does not affect the\n"
      "result. Settings (table in the manual): motion_time, the time limit of one motion that\n"
      "is not straight, s; grasps and places, how many of them to try at most; friction between\n"
      "hand and object; payload, the mass of the object, kg; samples of the grasp search.\n\n"
      "Returns a TaskPlan. Raises InputError for steps that can't follow each other and for\n"
      "names that the scene lacks.");
}

}  // namespace handway::python
