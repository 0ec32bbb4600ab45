#include "arrays.h"
#include "bindings.h"
#include "handway/planning/core/request_parameters.h"
#include "keyword_settings.h"
#include "planner_model.h"
#include "scene_questions.h"

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

namespace py = pybind11;

namespace handway::python {
namespace {

using geometric::Parameter;

std::vector<std::string> options_of(const Parameter& parameter) {
  const auto* choice = std::get_if<geometric::Choice>(&parameter.value);
  return choice != nullptr ? choice->options : std::vector<std::string>{};
}

/// A parameter with its value at the time of access.
struct ParameterView {
  Parameter parameter;
  py::object value;
};

py::dict parameters_of(const PlannerModel& planner) {
  py::dict parameters;
  for (const Parameter& parameter : planner.parameters()) {
    parameters[py::str(parameter.key)] = ParameterView{parameter, value_of(parameter)};
  }
  return parameters;
}

/// Describes the settings of a request, in SI units.
std::vector<geometric::BoundParameter> keywords_of(planning::PlanRequest& request) {
  return in_si_units(planning::parameters_of(request));
}

std::optional<geometric::Configuration> end_of(const SceneModel& scene,
                                               const std::optional<Array>& array,
                                               const char* argument) {
  if (!array) {
    return std::nullopt;
  }
  return vector_from(*array, scene.robot().variable_count(), argument);
}

PlanOutcome plan(PlannerModel& planner, const SceneModel& scene, const std::optional<Array>& start,
                 const std::optional<Array>& goal, std::uint64_t seed, const py::object& goal_pose,
                 const py::kwargs& settings) {
  planning::PlanRequest request;
  request.seed = seed;
  set_from_keywords(keywords_of(request), settings);
  const planning::PlanningProblem problem = scene.problem_between(
      end_of(scene, start, "start"), end_of(scene, goal, "goal"), goal_poses_from(goal_pose));
  return planner.plan(problem, request);
}

void set_all(PlannerModel& planner, const py::kwargs& values) {
  for (const auto& [key, value] : values) {
    planner.set(py::str(key), py::reinterpret_borrow<py::object>(value));
  }
}

void bind_parameter(py::module_& module) {
  py::class_<ParameterView>(module, "Parameter",
                            "Setting of a planner, with its value at the time of access.")
      .def_property_readonly(
          "key", [](const ParameterView& view) { return view.parameter.key; },
          "Key: the setting's name here, in scenes and on the command line.")
      .def_property_readonly(
          "label", [](const ParameterView& view) { return view.parameter.label; },
          "Label in the workbench.")
      .def_property_readonly(
          "unit", [](const ParameterView& view) { return view.parameter.unit; },
          "Unit; empty for a bare number.")
      .def_property_readonly(
          "help", [](const ParameterView& view) { return view.parameter.help; },
          "Description, one or two sentences.")
      .def_readonly("value", &ParameterView::value, "Value: a bool, int, float or str.")
      .def_property_readonly(
          "lower", [](const ParameterView& view) { return view.parameter.lower; },
          "Least value of a number, inclusive.")
      .def_property_readonly(
          "upper", [](const ParameterView& view) { return view.parameter.upper; },
          "Largest value of a number, inclusive.")
      .def_property_readonly(
          "options", [](const ParameterView& view) { return options_of(view.parameter); },
          "Words to choose from; empty for numbers and bools.")
      .def("__repr__", [](const ParameterView& view) {
        return "<handway.Parameter " + view.parameter.key + "=" + to_text(view.parameter) + ">";
      });
}

void bind_planner_class(py::module_& module) {
  planning::PlanRequest usual;
  const std::string settings = keywords_text(keywords_of(usual));
  py::class_<PlannerModel>(module, "Planner",
                           "Planner of paths, with settings by key: planner[\"rho_a\"] = 0.01.\n\n"
                           "It runs once at a time; a second call raises RuntimeError.")
      .def_property_readonly(
          "name", [](const PlannerModel& p) { return p.planner().name(); }, "Name of the planner.")
      .def_property_readonly(
          "description", [](const PlannerModel& p) { return p.planner().description(); },
          "Description, one sentence.")
      .def_property_readonly(
          "uses_pmds", [](const PlannerModel& p) { return p.planner().capabilities().uses_pmds; },
          "True if it samples the hand in a basis.")
      .def_property_readonly(
          "uses_threads",
          [](const PlannerModel& p) { return p.planner().capabilities().uses_threads; },
          "True if more threads make it faster.")
      .def_property_readonly(
          "deterministic",
          [](const PlannerModel& p) { return p.planner().capabilities().deterministic; },
          "True if equal seeds give equal bits.")
      .def_property_readonly("parameters", &parameters_of,
                             "Settings as a dict of Parameter by key.")
      .def("__getitem__", &PlannerModel::get, py::arg("key"))
      .def("__setitem__", &PlannerModel::set, py::arg("key"), py::arg("value"))
      .def("set", &set_all, "Sets parameters by keyword: planner.set(rho_a=0.01, smooth=False).")
      .def(
          "plan", &plan, py::arg("scene"), py::kw_only(), py::arg("start") = py::none(),
          py::arg("goal") = py::none(), py::arg("seed") = 1, py::arg("goal_pose") = py::none(),
          ("Finds a path that is free of collisions, and certifies its clearance.\n\n"
           "start, goal: [variables], rad or m; the scene's if not given.\n"
           "goal_pose: a PoseGoal, or several of which one is to be reached; goal is then for the\n"
           "joints that don't move their links.\n"
           "seed: seed of all random choices.\n" +
           settings +
           "\nOther Python threads run meanwhile; Ctrl-C stops it. If no path is found, the "
           "Result\n"
           "is not solved. Raises InputError if the problem can't be planned at all.")
              .c_str())
      .def("__repr__",
           [](const PlannerModel& p) { return "<handway.Planner " + p.planner().name() + ">"; });
}

py::dict loaded_plugins() {
  py::dict plugins;
  for (const planning::LoadedPlugin& plugin : plugin_manager().loaded()) {
    plugins[py::str(plugin.name)] = plugin.version;
  }
  return plugins;
}

py::dict refused_plugins() {
  py::dict plugins;
  for (const planning::RefusedPlugin& plugin : plugin_manager().refused()) {
    plugins[py::str(plugin.file.string())] = plugin.reason;
  }
  return plugins;
}

}  // namespace

void bind_planner(py::module_& module) {
  bind_parameter(module);
  bind_planner_class(module);
  module.def(
      "planners", [] { return plugin_manager().planners().names(); },
      "Returns the names of all planners, those of plugins included; the first is the default.");
  module.def(
      "planner", [](const std::string& name) { return make_planner(name); }, py::arg("name") = "",
      "Returns the planner called name, or the default planner, with default settings.\n\n"
      "Raises InputError with the names of all planners if there is none called name.");
  module.def("plugins", &loaded_plugins, "Returns the versions of the loaded plugins, by name.");
  module.def("refused_plugins", &refused_plugins,
             "Returns the reasons why plugins were not loaded, by file.");
}

}  // namespace handway::python
