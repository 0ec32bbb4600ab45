#include "arrays.h"
#include "bindings.h"
#include "handway/geometric/formats/program_steps.h"
#include "handway/geometric/io/input_error.h"
#include "handway/planning/core/request_parameters.h"
#include "handway/planning/tasks/task.h"
#include "handway/planning/tasks/task_file.h"
#include "keyword_settings.h"
#include "planner_model.h"
#include "scene_questions.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <variant>
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

bool is_list_of_names(const py::object& value) {
  return (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) &&
         py::len(value) > 0 && py::isinstance<py::str>(value[py::int_(0)]);
}

// One name, or several.
std::vector<std::string> names_from(const py::object& names) {
  return py::isinstance<py::str>(names) ? std::vector<std::string>{names.cast<std::string>()}
                                        : names.cast<std::vector<std::string>>();
}

planning::PlaceStep place_from(const py::dict& step) {
  allow_keys(step, {"place", "on", "lower", "retreat"});
  planning::PlaceStep place;
  const py::object where = step["place"];
  if (py::isinstance<py::str>(where) || is_list_of_names(where)) {
    place.supports = names_from(where);
    if (step.contains("on")) {
      throw InputError({"steps", "on", "names in \"place\", too", "a pose in \"place\"", ""});
    }
  } else {
    place.pose = pose_from(where.cast<Array>(), "place");
    place.supports = step.contains("on") ? names_from(step["on"]) : std::vector<std::string>();
  }
  place.lower = length_from(step, "lower", place.lower);
  place.retreat = length_from(step, "retreat", place.retreat);
  return place;
}

planning::TaskStep move_from(const SceneModel& scene, const py::dict& step) {
  allow_keys(step, {"move", "in"});
  const py::object to = step["move"];
  if (py::isinstance<geometric::PoseGoal>(to)) {
    planning::PoseStep move{to.cast<geometric::PoseGoal>()};
    move.goal.reference = step.contains("in") ? step["in"].cast<std::string>() : std::string();
    return move;
  }
  allow_keys(step, {"move"});
  if (py::isinstance<py::str>(to)) {
    return planning::move_to_posture(scene.scene(), to.cast<std::string>(), "steps");
  }
  return planning::MoveStep{vector_from(to.cast<Array>(), scene.robot().variable_count(), "move"),
                            "a configuration"};
}

planning::LineStep line_from(const py::dict& step) {
  allow_keys(step, {"line", "in"});
  planning::LineStep line;
  line.shift = vector_from(step["line"].cast<Array>(), 3, "line");
  line.reference = step.contains("in") ? step["in"].cast<std::string>() : std::string();
  if (!(line.shift.norm() > 0.0 && line.shift.norm() <= geometric::kLongestStraightMotion)) {
    throw InputError(
        {"steps", "line", fmt::format("a length of {:g} m", line.shift.norm()),
         fmt::format("a length above 0, up to {:g} m", geometric::kLongestStraightMotion), ""});
  }
  return line;
}

planning::WaitStep wait_from(const py::dict& step) {
  allow_keys(step, {"wait"});
  const planning::WaitStep wait{step["wait"].cast<double>()};
  if (!(wait.duration > 0.0 && wait.duration <= geometric::kLongestWait)) {
    throw InputError({"steps", "wait", fmt::format("{}", wait.duration),
                      fmt::format("a time above 0, up to {:g} s", geometric::kLongestWait), ""});
  }
  return wait;
}

planning::OutputStep output_from(const py::dict& step) {
  allow_keys(step, {"output", "value"});
  planning::OutputStep output{step["output"].cast<std::string>()};
  if (output.name.empty() || !step.contains("value")) {
    throw InputError({"steps", "output", output.name.empty() ? "an empty name" : "no value",
                      "the name of an output, and its \"value\": a bool or a number", ""});
  }
  const py::object value = step["value"];
  if (py::isinstance<py::bool_>(value)) {
    output.value = value.cast<bool>();
    return output;
  }
  output.value = value.cast<double>();
  if (!std::isfinite(std::get<double>(output.value))) {
    throw InputError({"steps", "value", value_text(output), "a bool or a finite number", ""});
  }
  return output;
}

void append_steps(const SceneModel& scene, const py::object& steps, planning::Task& task);

void append_alternatives(const SceneModel& scene, const py::dict& step, planning::Task& task) {
  allow_keys(step, {"first_of"});
  const std::size_t index = task.size();
  task.emplace_back(planning::FirstOfStep{});
  planning::FirstOfStep first_of;
  int lists = 0;
  for (const py::object& steps : step["first_of"].cast<std::vector<py::object>>()) {
    const std::size_t begin = task.size();
    append_steps(scene, steps, task);
    if (py::len(steps) == 0) {
      throw InputError({"steps", "first_of", "an empty list", "lists with at least one step", ""});
    }
    ++lists;
    if (task.size() == begin) {
      continue;  // all of its steps are disabled
    }
    first_of.lengths.push_back(task.size() - begin);
    first_of.words.append(first_of.words.empty() ? "" : " or ").append(to_string(task[begin]));
  }
  if (lists < 2) {
    throw InputError(
        {"steps", "first_of", fmt::format("{} lists", lists), "at least two lists of steps", ""});
  }
  if (first_of.lengths.empty()) {
    task.pop_back();
  } else {
    task[index] = std::move(first_of);
  }
}

void append_step(const SceneModel& scene, const py::dict& step, planning::Task& task) {
  if (step.contains("pick")) {
    allow_keys(step, {"pick", "approach", "lift"});
    planning::PickStep pick{step["pick"].cast<std::string>()};
    pick.approach = length_from(step, "approach", pick.approach);
    pick.lift = length_from(step, "lift", pick.lift);
    task.emplace_back(std::move(pick));
  } else if (step.contains("place")) {
    task.emplace_back(place_from(step));
  } else if (step.contains("line")) {
    task.emplace_back(line_from(step));
  } else if (step.contains("wait")) {
    task.emplace_back(wait_from(step));
  } else if (step.contains("output")) {
    task.emplace_back(output_from(step));
  } else if (step.contains("first_of")) {
    append_alternatives(scene, step, task);
  } else if (step.contains("move")) {
    task.push_back(move_from(scene, step));
  } else {
    allow_keys(step, {"pick", "place", "move", "line", "wait", "output", "first_of"});
    throw InputError({"steps", "", "an empty dict",
                      "a dict with the key pick, place, move, line, wait, output or first_of", ""});
  }
}

void append_steps(const SceneModel& scene, const py::object& steps, planning::Task& task) {
  for (const py::dict& step : steps.cast<std::vector<py::dict>>()) {
    if (!step.contains("disabled")) {
      append_step(scene, step, task);
      continue;
    }
    const bool disabled = step["disabled"].cast<bool>();
    py::dict rest(step.attr("copy")());
    rest.attr("pop")("disabled");
    planning::Task one;  // also a disabled step has to be one
    append_step(scene, rest, disabled ? one : task);
  }
}

planning::Task task_of(const SceneModel& scene, const py::object& steps) {
  if (py::isinstance<py::str>(steps)) {
    return planning::program_task(scene.scene(), steps.cast<std::string>());
  }
  planning::Task task;
  append_steps(scene, steps, task);
  return task;
}

/// Describes the options that are keyword arguments.
std::vector<geometric::BoundParameter> keywords_of(planning::TaskOptions& options) {
  std::vector<geometric::BoundParameter> keywords = parameters_of(options);
  keywords.insert(keywords.begin(), planning::threads_parameter(options.threads, "the result"));
  return keywords;
}

TaskPlan plan_task(PlannerModel& planner, const SceneModel& scene, const py::object& steps,
                   std::uint64_t seed, const py::kwargs& settings) {
  const planning::Task task = task_of(scene, steps);
  planning::TaskOptions options;
  options.seed = seed;
  set_from_keywords(keywords_of(options), settings);
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
          "Kind: approach, reach, close, lift, carry, lower, open, retreat, move, line, wait or\n"
          "output.")
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
      .def_readonly("rest", &TaskStage::rest, "Time of a stage wait, s; 0 of other stages.")
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
  planning::TaskOptions usual;
  py::object planner = module.attr("Planner");
  planner.attr("plan_task") = py::cpp_function(
      &plan_task, py::is_method(planner), py::name("plan_task"), py::arg("scene"), py::arg("steps"),
      py::kw_only(), py::arg("seed") = 1,
      ("Plans a task: picks objects, carries them and places them.\n\n"
       "scene: the scene in which the task begins, at its start.\n"
       "steps: dicts, each with one of the keys pick (the name of an object; with approach and\n"
       "lift, m), place (the name of the object or frame on which it is placed, or its pose\n"
       "[4, 4] in the world; with lower and retreat, m), move (\"start\", the name of a posture, "
       "a\n"
       "configuration [variables], or a PoseGoal, with in, the object or frame to which its pose\n"
       "is relative), line (a vector, m, by which the palm moves; with in, an object or frame\n"
       "along whose axes, or \"palm\"), wait (a time, s), output (the name of an output of the\n"
       "controller; with value, a bool or a number) and first_of (lists of steps, of which the\n"
       "first that is possible is done); or the name of a program of the scene, \"\" for its only\n"
       "one. Steps with disabled=True are left out.\n"
       "seed: seed of all random choices.\n" +
       keywords_text(keywords_of(usual)) +
       "\nReturns a TaskPlan. Raises InputError for steps that can't follow each other and for\n"
       "names that the scene lacks.")
          .c_str());
}

}  // namespace handway::python
