#include "bindings.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/mesh/depth_camera.h"
#include "handway/geometric/mesh/point_cloud.h"
#include "handway/geometric/setup/mounting.h"
#include "handway/geometric/setup/moving_group.h"
#include "handway/geometric/setup/placing.h"
#include "handway/planning/edits/arranging.h"
#include "handway/planning/edits/cloud_import.h"
#include "handway/planning/edits/robot_edits.h"
#include "handway/planning/edits/scene_edits.h"
#include "handway/planning/grasps/given_grasps.h"
#include "keyword_settings.h"
#include "planner_model.h"
#include "scene_questions.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace handway::python {
namespace {

using geometric::InputError;
using geometric::Pose;
using geometric::RobotInstance;
using geometric::Scene;
using SceneChange = std::shared_ptr<Scene>;

std::string text_of(const py::object& value) { return py::str(value); }

std::unique_ptr<SceneModel> made(SceneChange scene,
                                 const std::shared_ptr<const sampling::PmdBasis>& basis = nullptr) {
  const py::gil_scoped_release release;
  return std::make_unique<SceneModel>(std::move(scene), basis);
}

std::unique_ptr<SceneModel> changed(const SceneModel& model, SceneChange scene) {
  return made(std::move(scene), model.problem().basis);
}

Pose pose_or_identity(const py::object& X, const std::string& argument) {
  return X.is_none() ? Pose::Identity() : pose_from(py::cast<Array>(X), argument);
}

RobotInstance robot_from(const py::object& reference, const std::string& name,
                         const py::object& xacro) {
  const std::filesystem::path file =
      geometric::find_resource(geometric::ResourceKind::kRobot, text_of(reference),
                               std::filesystem::current_path(), "model");
  static_cast<void>(plugin_manager());  // they read other formats
  RobotInstance robot;
  robot.model = geometric::load_robot(file, xacro_arguments_from(xacro));
  robot.name = name.empty() ? robot.model->name() : name;
  robot.configuration = robot.model->neutral();
  return robot;
}

void check_name(const Scene& scene, const std::string& name) {
  if (find_robot_with_part(scene, name) != nullptr || find_object(scene, name) != nullptr) {
    throw InputError({"name", "", "\"" + name + "\", which is taken", "a name of its own", ""});
  }
}

std::unique_ptr<SceneModel> new_scene(const py::object& model, const std::string& name,
                                      const py::object& X_WB, const py::object& xacro) {
  auto scene = std::make_shared<Scene>();
  scene->robots.push_back(robot_from(model, name, xacro));
  scene->name = scene->robots.front().name;
  scene->robots.front().X_WB = pose_or_identity(X_WB, "X_WB");
  scene->warnings = scene->robots.front().model->description().warnings;
  return made(std::move(scene));
}

std::unique_ptr<SceneModel> with_robot(const SceneModel& model, const py::object& file,
                                       const std::string& name, const py::object& X,
                                       const std::string& mount, const std::string& link,
                                       const py::object& xacro) {
  auto scene = std::make_shared<Scene>(model.scene());
  RobotInstance robot = robot_from(file, name, xacro);
  check_name(*scene, robot.name);
  if (mount.empty() != link.empty()) {
    throw InputError({"mount", "", "a mount without a link, or the other way round", "both", ""});
  }
  const Pose pose = pose_or_identity(X, "X");
  const std::string called = robot.name;
  if (mount.empty()) {
    robot.X_WB = pose;
  }
  scene->robots.push_back(std::move(robot));
  if (!mount.empty()) {
    mount_robot(*scene, called, mount, link, pose);
  }
  return changed(model, std::move(scene));
}

std::string json_of(const py::object& value) {  // JSON is YAML
  return py::str(py::module_::import("json").attr("dumps")(value));
}

std::unique_ptr<SceneModel> with_objects(const SceneModel& model, const py::object& objects) {
  const std::string text = json_of(objects);  // as a scene file has them
  auto scene = std::make_shared<Scene>(model.scene());
  const Scene read = geometric::read_objects(text, "objects", *scene);
  for (const geometric::SceneObject& object : read.objects) {
    const auto same = std::ranges::find(scene->objects, object.name, &geometric::SceneObject::name);
    if (same != scene->objects.end()) {
      *same = object;
    } else {
      check_name(*scene, object.name);
      scene->objects.push_back(object);
    }
    scene->display.set(object.name, read.display.of(object.name));
  }
  return changed(model, std::move(scene));
}

std::unique_ptr<SceneModel> without_object(const SceneModel& model, const std::string& name) {
  planning::need_object(model.scene(), name);
  auto scene = std::make_shared<Scene>(model.scene());
  geometric::remove_objects(*scene, {name});
  return changed(model, std::move(scene));
}

std::unique_ptr<SceneModel> with_object_at(const SceneModel& model, const std::string& name,
                                           const Array& X_PO) {
  planning::need_object(model.scene(), name);
  auto scene = std::make_shared<Scene>(model.scene());
  std::ranges::find(scene->objects, name, &geometric::SceneObject::name)->X_PO =
      pose_from(X_PO, "X_PO");
  return changed(model, std::move(scene));
}

std::unique_ptr<SceneModel> with_frame(const SceneModel& model, const std::string& name,
                                       const Array& X_PF, const std::string& on) {
  const geometric::NamedFrame frame{name, on, pose_from(X_PF, "X_PF")};
  const planning::SceneState state =
      planning::with_frame({std::make_shared<Scene>(model.scene())}, frame);
  return changed(model, std::make_shared<Scene>(*state.scene));
}

std::unique_ptr<SceneModel> with_query(const SceneModel& model, const std::optional<Array>& start,
                                       const std::optional<Array>& goal,
                                       const py::object& goal_pose) {
  auto scene = std::make_shared<Scene>(model.scene());
  const int variables = model.robot().variable_count();
  if (start) {
    scene->start = vector_from(*start, variables, "start");
    scene->robots.front().configuration = *scene->start;
  }
  if (goal) {
    scene->goal = vector_from(*goal, variables, "goal");
    scene->goal_poses.clear();
  }
  if (!goal_pose.is_none()) {
    scene->goal_poses = goal_poses_from(goal_pose);
    for (const geometric::PoseGoal& pose : scene->goal_poses) {
      static_cast<void>(needed_link(model.robot(), pose.link));
    }
  }
  return changed(model, std::move(scene));
}

std::unique_ptr<SceneModel> with_constraints(const SceneModel& model,
                                             const py::object& constraints) {
  auto scene = std::make_shared<Scene>(model.scene());
  for (const geometric::PathConstraint& constraint :
       geometric::read_constraints(json_of(constraints), "constraints", *scene)) {
    std::erase_if(scene->constraints,
                  [&](const auto& other) { return other.name == constraint.name; });
    scene->constraints.push_back(constraint);
  }
  return changed(model, std::move(scene));
}

std::unique_ptr<SceneModel> without_constraint(const SceneModel& model, const std::string& name) {
  auto scene = std::make_shared<Scene>(model.scene());
  const auto removed =
      std::erase_if(scene->constraints, [&](const auto& other) { return other.name == name; });
  if (removed == 0) {
    std::vector<std::string> names;
    for (const geometric::PathConstraint& constraint : scene->constraints) {
      names.push_back(constraint.name);
    }
    throw InputError({"constraint", "", "\"" + name + "\"", "a constraint of the scene",
                      geometric::advise_name(name, names)});
  }
  return changed(model, std::move(scene));
}

std::unique_ptr<SceneModel> with_group(const SceneModel& model, const py::args& names) {
  auto scene = std::make_shared<Scene>(model.scene());
  std::vector<std::string> group;
  for (const py::handle& name : names) {
    group.push_back(py::cast<std::string>(name));
  }
  geometric::set_moving_group(*scene, group);
  return changed(model, std::move(scene));
}

using planning::ObjectNames;
using planning::SceneState;

SceneState state_of(const SceneModel& model) {
  return {std::make_shared<const Scene>(model.scene()), model.problem().basis};
}

// The first robot's configuration, which attached objects go with.
const geometric::Configuration& posture_of(const SceneModel& model) {
  return model.problem().start;
}

std::unique_ptr<SceneModel> made(const SceneState& state) {
  const py::gil_scoped_release release;
  return std::make_unique<SceneModel>(state.scene, state.basis);
}

// Rows of points [n, 3], or [n, 6] with colours from 0 to 255.
geometric::PointCloud cloud_from(const Array& points) {
  const Batch rows =
      batch_from(points, points.ndim() == 2 && points.shape(1) == 6 ? 6 : 3, "points");
  geometric::PointCloud cloud;
  for (const Eigen::VectorXd& row : rows.rows) {
    if (row.head<3>().cwiseAbs().maxCoeff() >
        static_cast<double>(geometric::kLargestCloudCoordinate)) {
      throw InputError({"points", "", "a coordinate farther away than 160 m", "metres", ""});
    }
    cloud.points.emplace_back(row.head<3>().cast<float>());
    if (row.size() == 6) {
      const Eigen::Vector3d parts = row.tail<3>().cwiseMax(0.0).cwiseMin(255.0);
      cloud.colors.push_back({static_cast<std::uint8_t>(parts[0]),
                              static_cast<std::uint8_t>(parts[1]),
                              static_cast<std::uint8_t>(parts[2])});
    }
  }
  return cloud;
}

std::unique_ptr<SceneModel> with_grasps(const SceneModel& model, const std::string& object,
                                        const py::object& file) {
  return made(planning::with_grasps(state_of(model), object, file_name_from(file, "file")));
}

geometric::DepthCamera camera_from(const std::array<double, 4>& values) {
  const auto is_valid = [](double value) { return value > 0.0 && value < 1e5; };
  if (!std::ranges::all_of(values, is_valid)) {
    throw InputError(
        {"hidden_from", "", "another number", "fx, fy, cx, cy in pixels, above 0", ""});
  }
  geometric::DepthCamera camera;
  camera.focal = {values[0], values[1]};
  camera.centre = {values[2], values[3]};
  return camera;
}

/// Describes the settings of an import, in SI units.
std::vector<geometric::BoundParameter> keywords_of(planning::CloudImport& import) {
  return in_si_units(parameters_of(import));
}

std::unique_ptr<SceneModel> with_cloud(const SceneModel& model, const std::string& name,
                                       const Array& points, const py::object& X_WC, bool robots,
                                       const ObjectNames& cut_out, bool outliers,
                                       const std::optional<std::array<double, 4>>& hidden_from,
                                       const py::kwargs& settings) {
  check_name(model.scene(), name);
  planning::CloudImport import;
  import.name = name;
  import.X_WC = pose_or_identity(X_WC, "X_WC");
  set_from_keywords(keywords_of(import), settings);
  import.bodies.robots = !robots;
  import.bodies.objects = cut_out;
  if (outliers) {
    import.outliers.reset();
  }
  if (hidden_from) {
    import.hidden_from = camera_from(*hidden_from);
  }
  const SceneState state = state_of(model);
  const planning::ImportedCloud cloud =
      planning::import_cloud(*state.scene, posture_of(model), cloud_from(points), import, "points");
  return made(with_cloud(state, cloud));
}

// A shift or a point in m, as far as scenes reach.
Eigen::Vector3d triple_from(const std::array<double, 3>& values, const char* argument) {
  constexpr double kFarthest = 1e3;
  const Eigen::Vector3d v(values[0], values[1], values[2]);
  if (!v.allFinite() || v.cwiseAbs().maxCoeff() > kFarthest) {
    throw InputError({argument, "", "a number that is not within ±1000", "three lengths, m", ""});
  }
  return v;
}

int axis_from(const std::string& name) {
  const std::size_t axis = std::string("xyz").find(name);
  if (name.size() != 1 || axis == std::string::npos) {
    throw InputError({"axis", "", "\"" + name + "\"", "x, y or z", ""});
  }
  return static_cast<int>(axis);
}

planning::AlignTo side_from(const std::string& name) {
  if (name == "min") {
    return planning::AlignTo::kLeast;
  }
  if (name == "max") {
    return planning::AlignTo::kMost;
  }
  if (name != "centre") {
    throw InputError({"to", "", "\"" + name + "\"", "min, centre or max", ""});
  }
  return planning::AlignTo::kCentre;
}

py::array_t<double> object_pose_of(const SceneModel& model, const std::string& name,
                                   const py::object& q) {
  const geometric::SceneObject& object = planning::need_object(model.scene(), name);
  const geometric::Configuration at =
      q.is_none() ? posture_of(model)
                  : vector_from(py::cast<Array>(q), model.robot().variable_count(), "q");
  return pose_array(object_pose(model.scene(), at, object));
}

// The scene after an edit of some of its objects, which are there.
template <typename Edit>
std::unique_ptr<SceneModel> edited(const SceneModel& model, const ObjectNames& objects,
                                   const Edit& edit) {
  planning::need_objects(model.scene(), objects);
  return made(edit(state_of(model), posture_of(model)));
}

std::unique_ptr<SceneModel> aligned_scene(const SceneModel& model, const ObjectNames& objects,
                                          const std::string& axis, const std::string& to) {
  return edited(model, objects, [&](const SceneState& state, const geometric::Configuration& q) {
    return aligned(state, q, objects, axis_from(axis), side_from(to));
  });
}

std::unique_ptr<SceneModel> distributed_scene(const SceneModel& model, const ObjectNames& objects,
                                              const std::string& axis) {
  return edited(model, objects, [&](const SceneState& state, const geometric::Configuration& q) {
    return distributed(state, q, objects, axis_from(axis));
  });
}

std::unique_ptr<SceneModel> with_rows(const SceneModel& model, const ObjectNames& objects,
                                      const std::array<int, 3>& count,
                                      const std::array<double, 3>& spacing) {
  return edited(model, objects, [&](const SceneState& state, const geometric::Configuration& q) {
    const planning::LinearArray rows{{count[0], count[1], count[2]},
                                     triple_from(spacing, "spacing")};
    return copied(state, q, objects, rows.motions()).state;
  });
}

std::unique_ptr<SceneModel> with_circle(const SceneModel& model, const ObjectNames& objects,
                                        int copies, const std::string& axis,
                                        const std::array<double, 3>& centre, double angle,
                                        bool turning) {
  return edited(model, objects, [&](const SceneState& state, const geometric::Configuration& q) {
    if (!(std::abs(angle) <= 2.0 * std::numbers::pi)) {
      throw InputError({"angle", "", std::to_string(angle), "a full turn at most, rad", ""});
    }
    const planning::CircularArray circle{copies, axis_from(axis), triple_from(centre, "centre"),
                                         angle, turning};
    const Eigen::Vector3d middle = bounds(*state.scene, q, objects).centre();
    return copied(state, q, objects, circle.motions(middle)).state;
  });
}

std::unique_ptr<SceneModel> dropped_scene(const SceneModel& model, const ObjectNames& objects) {
  return edited(model, objects, [&](const SceneState& state, const geometric::Configuration& q) {
    return dropped(state, q, objects);
  });
}

std::unique_ptr<SceneModel> attached_scene(const SceneModel& model, const ObjectNames& objects,
                                           const std::string& link,
                                           const std::vector<std::string>& touching) {
  return edited(model, objects, [&](const SceneState& state, const geometric::Configuration& q) {
    return attached(state, q, objects, {state.scene->robots.front().name, link}, touching);
  });
}

std::unique_ptr<SceneModel> detached_scene(const SceneModel& model, const ObjectNames& objects) {
  return edited(model, objects, [&](const SceneState& state, const geometric::Configuration& q) {
    return detached(state, q, objects);
  });
}

std::unique_ptr<SceneModel> mounted_scene(const SceneModel& model, const std::string& robot,
                                          const std::string& mount, const std::string& link,
                                          const py::object& X) {
  return made(with_mount(state_of(model), posture_of(model), robot, {mount, link},
                         pose_or_identity(X, "X")));
}

std::unique_ptr<SceneModel> unmounted_scene(const SceneModel& model, const std::string& robot) {
  return made(without_mount(state_of(model), posture_of(model), robot));
}

void save(const SceneModel& model, const py::object& file) {
  geometric::write_scene(model.scene(), text_of(file));
}

std::vector<std::string> export_scene(const SceneModel& model, const std::string& format,
                                      const py::object& folder) {
  const planning::SceneExporter* exporter = plugin_manager().find_scene_exporter(format);
  if (exporter == nullptr) {
    std::vector<std::string> names;
    for (const auto& other : plugin_manager().scene_exporters()) {
      names.push_back(other->name());
    }
    throw InputError({"format", "", "\"" + format + "\"", "a format for scenes",
                      geometric::advise_name(format, names)});
  }
  std::vector<std::string> files;
  for (const std::filesystem::path& file : exporter->write(model.scene(), text_of(folder))) {
    files.push_back(file.string());
  }
  return files;
}

}  // namespace

void bind_editing(py::module_& module) {
  planning::CloudImport import;
  auto scene = py::reinterpret_borrow<py::class_<SceneModel>>(module.attr("Scene"));
  scene
      .def("with_robot", &with_robot, py::arg("model"), py::arg("name") = "", py::kw_only(),
           py::arg("X") = py::none(), py::arg("mount") = "", py::arg("link") = "",
           py::arg("xacro") = py::none(),
           "Returns this scene with one more robot.\n\n"
           "model: name in the library, or a robot's file. name: the model's own if empty.\n"
           "mount, link: the robot of the scene and its link that carries it; it stands in the\n"
           "world if both are empty. X: its base in that link or in the world, [4, 4], m.\n"
           "xacro: a dict with the arguments of a robot file in xacro.")
      .def("with_objects", &with_objects, py::arg("objects"),
           "Returns this scene with these objects, in place of those of the same names.\n\n"
           "objects: a list of dicts with the keys that objects of scene files have, such as\n"
           "{\"name\": \"can\", \"cylinder\": {\"radius\": 0.03, \"length\": 0.2},\n"
           "\"pose\": {\"xyz\": [0.5, 0, 0.1]}}.")
      .def("with_cloud", &with_cloud, py::arg("name"), py::arg("points"),
           py::arg("X_WC") = py::none(), py::kw_only(), py::arg("robots") = false,
           py::arg("cut_out") = ObjectNames(), py::arg("outliers") = false,
           py::arg("hidden_from") = py::none(),
           ("Returns this scene with points of a camera as an object called name.\n\n"
            "points: [n, 3], m, or [n, 6] with colours from 0 to 255, in a frame at X_WC, [4, 4],\n"
            "in the world. All cells of a grid that have a point are solid. Points of the objects\n"
            "cut_out are left out, and those of the robots at the start and what they carry,\n"
            "unless robots is true; so are single points, unless outliers is true. Objects that\n"
            "are found are called surface and object.\n"
            "hidden_from: fx, fy, cx, cy (pixels) of the depth camera at X_WC, in its optical\n"
            "frame: what the points hide from it becomes an object as well, called name and\n"
            "hidden.\n" +
            keywords_text(keywords_of(import)))
               .c_str())
      .def("without_object", &without_object, py::arg("name"),
           "Returns this scene without the object called name and the settings about it.")
      .def(
          "with_object_at", &with_object_at, py::arg("name"), py::arg("X_PO"),
          "Returns this scene with the object called name at X_PO, [4, 4], m: in the world, or in\n"
          "the link that carries it.")
      .def("with_frame", &with_frame, py::arg("name"), py::arg("X_PF"), py::kw_only(),
           py::arg("on") = "",
           "Returns this scene with a frame called name, in place of the one of that name.\n\n"
           "X_PF: its pose [4, 4], m, in the object or link of the first robot called on; in the\n"
           "world if on is empty.")
      .def("with_grasps", &with_grasps, py::arg("object"), py::arg("file"),
           "Returns this scene with a file of grasps (YAML or JSON) as those of an object: tasks\n"
           "pick it with these first.")
      .def("with_query", &with_query, py::arg("start") = py::none(), py::arg("goal") = py::none(),
           py::kw_only(), py::arg("goal_pose") = py::none(),
           "Returns this scene with another start or goal.\n\n"
           "start, goal: [variables], rad or m; as they are if None. goal_pose: as in\n"
           "Planner.plan(), in place of the goal.")
      .def("with_constraints", &with_constraints, py::arg("constraints"),
           "Returns this scene with these constraints along paths, in place of those of the same\n"
           "names.\n\n"
           "constraints: a list of dicts with the keys that constraints of scene files have, such\n"
           "as {\"name\": \"upright\", \"body\": \"can\", \"upright\": {\"angle_deg\": 10}}.")
      .def("without_constraint", &without_constraint, py::arg("name"),
           "Returns this scene without the constraint called name.")
      .def("with_group", &with_group,
           "Returns this scene with other joints to move; all others stay at the start.\n\n"
           "names: names of groups, robots and joints; without any, everything of the first robot\n"
           "moves.\n"
           "Robots that stand beside the first one and are named become one robot with it.")
      .def("object_pose", &object_pose_of, py::arg("name"), py::arg("q") = py::none(),
           "Returns the pose X_WO of an object in the world, [4, 4], m.\n\n"
           "q: [variables], rad or m, which an attached object goes with; the start if None.")
      .def("aligned", &aligned_scene, py::arg("objects"), py::kw_only(), py::arg("axis") = "x",
           py::arg("to") = "centre",
           "Returns this scene with objects aligned with the last one.\n\n"
           "objects: a list of names. axis: x, y or z of the world. to: the side of the bounding\n"
           "boxes: min, centre or max.")
      .def("distributed", &distributed_scene, py::arg("objects"), py::kw_only(),
           py::arg("axis") = "x",
           "Returns this scene with equal gaps between objects.\n\n"
           "objects: a list of three or more names. axis: x, y or z of the world.")
      .def("with_rows", &with_rows, py::arg("objects"), py::kw_only(), py::arg("count"),
           py::arg("spacing"),
           "Returns this scene with copies of objects in rows.\n\n"
           "count: numbers along x, y and z of the world, the originals included. spacing:\n"
           "distances of neighbours, m.")
      .def(
          "with_circle", &with_circle, py::arg("objects"), py::kw_only(), py::arg("copies"),
          py::arg("axis") = "z", py::arg("centre") = std::array<double, 3>{0.0, 0.0, 0.0},
          py::arg("angle") = 2.0 * std::numbers::pi, py::arg("turning") = true,
          "Returns this scene with copies of objects around an axis of the world.\n\n"
          "copies: their number, the originals included. centre: a point of the axis, m. angle:\n"
          "from the first to the last, rad; a full turn spreads them evenly. turning: whether the\n"
          "copies turn along.")
      .def("dropped", &dropped_scene, py::arg("objects"),
           "Returns this scene with objects dropped onto the surface below them, or the floor.")
      .def(
          "attached", &attached_scene, py::arg("objects"), py::arg("link"), py::kw_only(),
          py::arg("touching") = std::vector<std::string>{},
          "Returns this scene with objects attached to a link of the robot, where they are at the\n"
          "start.\n\n"
          "touching: links that may touch them. Objects that rest on something are raised by\n"
          "0.5 mm at most.")
      .def("detached", &detached_scene, py::arg("objects"),
           "Returns this scene with objects detached: they stay where they are at the start.")
      .def("mounted", &mounted_scene, py::arg("robot"), py::kw_only(), py::arg("mount"),
           py::arg("link"), py::arg("X") = py::none(),
           "Returns this scene with a robot mounted on another one.\n\n"
           "mount, link: the robot of the scene, or a part of it, and its link that carries the\n"
           "robot. X: the robot's base in that link, [4, 4], m.")
      .def("unmounted", &unmounted_scene, py::arg("robot"),
           "Returns this scene with a mounted robot taken off: it stays where it is.")
      .def("save", &save, py::arg("file"), "Writes a scene file (YAML).\n\nfile: replaced whole.")
      .def("export", &export_scene, py::arg("format"), py::arg("folder"),
           "Writes the scene for other programs.\n\n"
           "format: gltf, moveit-scene, or a plugin's. folder: created if it does not exist.\n"
           "Returns the files.");
  module.def("new_scene", &new_scene, py::arg("model"), py::arg("name") = "",
             py::arg("X_WB") = py::none(), py::kw_only(), py::arg("xacro") = py::none(),
             "Returns a scene with one robot and nothing around it.\n\n"
             "model: name in the library, or a robot's file. name: the model's own if empty.\n"
             "X_WB: its base in the world, [4, 4], m.\n"
             "xacro: a dict with the arguments of a robot file in xacro.");
}

}  // namespace handway::python
