#include "bindings.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/paths/path_file.h"
#include "keyword_settings.h"
#include "planner_model.h"
#include "scene_questions.h"

#include <pybind11/stl.h>

#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace py = pybind11;

namespace handway::python {
namespace {

using geometric::Configuration;
using geometric::InputError;
using geometric::RobotModel;

py::dict frames_of(const SceneModel& model) {
  py::dict frames;
  for (const geometric::NamedFrame& frame : model.scene().frames) {
    frames[py::str(frame.name)] = py::make_tuple(frame.parent, pose_array(frame.X_PF));
  }
  return frames;
}

py::object optional_array(const std::optional<Configuration>& q) {
  return q ? py::object(to_array(*q)) : py::object(py::none());
}

std::vector<std::string> names_of(const RobotModel& robot, const std::vector<int>& variables) {
  std::vector<std::string> names;
  names.reserve(variables.size());
  for (const int variable : variables) {
    names.push_back(robot.variable(variable).name);
  }
  return names;
}

std::vector<std::string> variable_names(const SceneModel& scene) {
  std::vector<int> all(static_cast<std::size_t>(scene.robot().variable_count()));
  std::iota(all.begin(), all.end(), 0);
  return names_of(scene.robot(), all);
}

std::vector<std::string> link_names(const SceneModel& scene) {
  std::vector<std::string> names;
  for (const geometric::Link& link : scene.robot().description().links) {
    names.push_back(link.name);
  }
  return names;
}

std::vector<std::string> object_names(const SceneModel& scene) {
  std::vector<std::string> names;
  for (const geometric::SceneObject& object : scene.scene().objects) {
    names.push_back(object.name);
  }
  return names;
}

py::array_t<double> configuration(const SceneModel& scene,
                                  const std::map<std::string, double>& values,
                                  const std::optional<Array>& others) {
  const geometric::RobotInstance& robot = scene.scene().robots.front();
  geometric::RobotState state(robot.model);
  state.set_configuration(others ? vector_from(*others, robot.model->variable_count(), "others")
                                 : robot.configuration);
  state.set_posture({"", "", values});
  return to_array(state.configuration());
}

planning::Path path_from(const SceneModel& scene, const Array& path) {
  if (path.ndim() != 2) {
    throw InputError({"path", "", std::to_string(path.ndim()) + " dimensions",
                      "an array [waypoints, variables]", ""});
  }
  return {batch_from(path, scene.robot().variable_count(), "path").rows};
}

planning::PathCheckResult check(const SceneModel& scene, const Array& array, double resolution,
                                const std::optional<Array>& start, const std::optional<Array>& goal,
                                const py::object& goal_pose) {
  if (!(resolution >= 1e-7 && resolution <= 1.0)) {
    throw InputError({"resolution", "", std::to_string(resolution), "1e-7 to 1 m", ""});
  }
  const planning::Path path = path_from(scene, array);
  const int variables = scene.robot().variable_count();
  const auto end = [&](const std::optional<Array>& given, const char* name) {
    return given ? std::optional(vector_from(*given, variables, name)) : std::nullopt;
  };
  const planning::PlanningProblem problem =
      scene.problem_between(end(start, "start"), end(goal, "goal"), goal_poses_from(goal_pose));
  planning::PathCheckResult result;
  run_interruptible(
      [&](const std::stop_token& stop) { result = check_path(problem, path, resolution, stop); });
  return result;
}

py::array_t<double> read_path(const SceneModel& scene, const py::object& file) {
  planning::JointsAtRest rest{scene.problem().start};
  const std::string name = file_name_from(file, "file");
  const planning::Path path = planning::read_path(scene.robot(), name, &rest);
  if (const std::string warning = rest.remark(name); !warning.empty()) {
    warn(warning);
  }
  return to_array(path.waypoints, scene.robot().variable_count());
}

void write_path(const SceneModel& scene, const Array& path, const py::object& file) {
  planning::write_path_csv(path_from(scene, path), scene.robot(), file_name_from(file, "file"));
}

void bind_contents(py::class_<SceneModel>& scene) {
  scene
      .def_property_readonly(
          "name", [](const SceneModel& s) { return s.scene().name; }, "Name of the scene.")
      .def_property_readonly(
          "description", [](const SceneModel& s) { return s.scene().description; },
          "Description of the scene.")
      .def_property_readonly(
          "warnings", [](const SceneModel& s) { return s.scene().warnings; },
          "Warnings of the reader, a sentence each.")
      .def_property_readonly(
          "robot", [](const SceneModel& s) { return s.robot().name(); },
          "Name of the planned robot's model.")
      .def_property_readonly("variables", &variable_names,
                             "Names of the independent joints, in the order of configurations.")
      .def_property_readonly("links", &link_names,
                             "Names of the planned robot's links, parents first.")
      .def_property_readonly("objects", &object_names, "Names of the objects.")
      .def_property_readonly(
          "arm", [](const SceneModel& s) { return names_of(s.robot(), s.problem().joints.arm); },
          "Names of the arm's variables.")
      .def_property_readonly(
          "hand", [](const SceneModel& s) { return names_of(s.robot(), s.problem().joints.hand); },
          "Names of the hand's variables, in the order of the basis' joints.")
      .def_property_readonly(
          "constraints",
          [](const SceneModel& s) {
            std::vector<std::string> names;
            for (const geometric::PathConstraint& constraint : s.scene().constraints) {
              names.push_back(constraint.name);
            }
            return names;
          },
          "Names of the constraints along paths.")
      .def_property_readonly(
          "group", [](const SceneModel& s) { return s.scene().group; },
          "Names of the groups, robots and joints that move; empty: all variables.")
      .def_property_readonly(
          "moving",
          [](const SceneModel& s) { return names_of(s.robot(), s.problem().joints.moving); },
          "Names of the variables that move; the others stay at the start.")
      .def_property_readonly(
          "lower", [](const SceneModel& s) { return to_array(s.robot().lower()); },
          "Lower limits, [variables], rad or m; -pi for a continuous joint, which has none.")
      .def_property_readonly(
          "upper", [](const SceneModel& s) { return to_array(s.robot().upper()); },
          "Upper limits, [variables], rad or m; pi for a continuous joint, which has none.")
      .def_property_readonly(
          "start", [](const SceneModel& s) { return optional_array(s.scene().start); },
          "Start configuration, [variables], rad or m; None if the scene has none.")
      .def_property_readonly(
          "goal", [](const SceneModel& s) { return optional_array(s.scene().goal); },
          "Goal configuration, [variables], rad or m; None if the scene has none.")
      .def_property_readonly(
          "frames", &frames_of,
          "Frames of the scene: a dict from names to pairs of parent and pose in it [4, 4], m.\n"
          "The parent is an object or a link of the first robot; empty: the world.")
      .def_property_readonly(
          "goal_poses", [](const SceneModel& s) { return s.scene().goal_poses; },
          "Goals as poses of a link; empty if the scene has none.")
      .def_property_readonly(
          "basis",
          [](const SceneModel& s) {
            return std::const_pointer_cast<sampling::PmdBasis>(s.problem().basis);
          },
          "Basis of the hand; None if it has none.");
}

void bind_questions(py::class_<SceneModel>& scene) {
  scene
      .def("within_limits", &within_limits, py::arg("q"),
           "Returns whether every variable is within its limits.\n\n"
           "q: [variables] or [n, variables]. Returns a bool or [n].")
      .def(
          "collides", &collides, py::arg("q"),
          "Returns whether the robot touches itself or anything else, or violates a constraint.\n\n"
          "q: [variables] or [n, variables], rad or m. Returns a bool or [n].")
      .def("clearance", &clearance, py::arg("q"),
           py::arg("enough") = std::numeric_limits<double>::infinity(),
           "Returns the distance of the closest pair of bodies that must not touch, m; 0 in\n"
           "collision.\n\n"
           "q: [variables] or [n, variables], rad or m. Returns a number or [n].\n"
           "enough: larger distances (m) count as this much, which is faster.")
      .def("collisions", &collisions, py::arg("q"),
           "Returns all pairs of bodies that touch, as pairs of names. q: [variables], rad or m.")
      .def(
          "violations", &violations, py::arg("q"),
          "Returns a sentence for each violated constraint of the scene. q: [variables], rad or m.")
      .def("closest_pair", &closest_pair, py::arg("q"),
           "Returns the closest pair: two names and the distance, m. q: [variables], rad or m.")
      .def("link_pose", &link_pose, py::arg("link"), py::arg("q"),
           "Returns the pose X_WL of a link in the world, [4, 4] or [n, 4, 4], m.\n\n"
           "q: [variables] or [n, variables], rad or m.")
      .def("configuration", &configuration, py::arg("values"), py::arg("others") = py::none(),
           "Returns a configuration from values (rad or m) by joint.\n\n"
           "others: [variables], for joints not named; the scene's configuration if None.\n"
           "Returns [variables].");
}

void bind_kinematics(py::class_<SceneModel>& scene) {
  scene
      .def("inverse_kinematics", &inverse_kinematics, py::arg("link"), py::arg("X_WL"),
           py::arg("near") = py::none(), py::arg("most") = 1, py::arg("free") = true,
           "Returns configurations in which a link is at X_WL, [4, 4], in the world.\n\n"
           "near: [variables]; the nearest configurations come first, and joints that don't move\n"
           "the link keep its values; the scene's configuration if None. most: largest number of\n"
           "configurations. free: leave out those in which the robot collides or violates a\n"
           "constraint.\n"
           "Returns [n, variables], rad or m; n is 0 if the pose is out of reach.")
      .def("jacobian", &jacobian, py::arg("link"), py::arg("q"),
           "Returns the Jacobian of a link's origin, [6, variables]: three rows for its velocity\n"
           "(m/s) and three for the link's angular velocity (rad/s) in the world, per unit speed\n"
           "of each variable. q: [variables], rad or m.")
      .def(
          "manipulability", &manipulability, py::arg("link"), py::arg("q"),
          "Returns Yoshikawa's manipulability of the origin of a link: 0 where the arm can't move\n"
          "it in some direction. q: [variables] or [n, variables], rad or m. Returns a number or "
          "[n].");
}

void bind_paths(py::class_<SceneModel>& scene) {
  scene
      .def("planner", &make_scene_planner, py::arg("name") = "",
           "Returns the planner that the scene names, with the scene's settings; or the planner\n"
           "called name, with the scene's settings if they are for this planner.")
      .def(
          "check", &check, py::arg("path"), py::arg("resolution") = 1e-3, py::kw_only(),
          py::arg("start") = py::none(), py::arg("goal") = py::none(),
          py::arg("goal_pose") = py::none(),
          "Checks a path: limits, both ends, and collisions of the exact meshes along it.\n\n"
          "path: [waypoints, variables], rad or m. resolution: largest motion of any point of the\n"
          "robot from one check to the next, m. start, goal: [variables]; the scene's\n"
          "if None. goal_pose: as in Planner.plan().")
      .def(
          "read_path", &read_path, py::arg("file"),
          "Reads a path (CSV, or a JointTrajectory as YAML or JSON). Returns [waypoints,\n"
          "variables], rad or m. Joints that the file does not have stay as at the scene's start;\n"
          "a UserWarning names them.")
      .def("write_path", &write_path, py::arg("path"), py::arg("file"),
           "Writes a path [waypoints, variables] as `handway plan --out` does (CSV).");
}

}  // namespace

void bind_scene(py::module_& module) {
  py::class_<SceneModel> scene(module, "Scene",
                               "Robot among objects, ready for planning and queries.\n\n"
                               "A scene never changes; threads may share it.");
  bind_contents(scene);
  bind_questions(scene);
  bind_kinematics(scene);
  bind_paths(scene);
  scene.def("__repr__", [](const SceneModel& s) {
    return "<handway.Scene \"" + s.scene().name + "\" with " + s.robot().name() + ">";
  });
  module.def(
      "load_scene",
      [](const py::object& file, const py::object& basis, const py::object& xacro) {
        const std::string path = file_name_from(file, "file");
        const std::string other = basis.is_none() ? std::string() : std::string(py::str(basis));
        const geometric::XacroArguments arguments = xacro_arguments_from(xacro);
        const py::gil_scoped_release release;
        return std::make_unique<SceneModel>(path, other, arguments);
      },
      py::arg("file"), py::kw_only(), py::arg("basis") = py::none(), py::arg("xacro") = py::none(),
      "Reads a scene, a robot, or a problem in a format that a plugin knows.\n\n"
      "basis: a hand basis (file, or name in the library) instead of the scene's.\n"
      "xacro: a dict with the arguments of a robot file in xacro.\n"
      "Raises InputError naming file, line and key of what is wrong.");
}

}  // namespace handway::python
