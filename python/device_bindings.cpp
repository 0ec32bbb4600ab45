#include "arrays.h"
#include "bindings.h"
#include "handway/device/emulators/arm_emulator.h"
#include "handway/device/emulators/hand_emulator.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_mapper.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "keyword_settings.h"
#include "planner_model.h"
#include "robot_connection.h"
#include "scene_model.h"

#include <pybind11/stl.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace py = pybind11;

namespace handway::python {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;

std::unique_ptr<RobotConnection> connect(const SceneModel& scene, const std::string& to) {
  auto problem = std::make_shared<const planning::PlanningProblem>(scene.problem());
  std::unique_ptr<RobotConnection> connection;
  run_interruptible([&](const std::stop_token& stop) {
    connection = std::make_unique<RobotConnection>(problem, to, stop);
  });
  return connection;
}

py::dict run(RobotConnection& connection, const planning::TimedPath& motion,
             const py::kwargs& settings) {
  device::MotionTolerances tolerances;
  set_from_keywords(parameters_of(tolerances), settings);
  RobotConnection::Outcome outcome;
  run_interruptible(
      [&](const std::stop_token& stop) { outcome = connection.run(motion, tolerances, stop); });
  py::dict errors;
  for (const auto& [joint, error] : outcome.largest_errors) {
    errors[py::str(joint)] = error;
  }
  const execution::MotionOutcome& how = outcome.motion;
  py::dict answer;
  answer["done"] = how.done;
  answer["started"] = how.started;
  answer["fault"] = how.fault.empty() ? how.collision : how.fault;
  answer["time"] = how.time;
  answer["stop_sent_ms"] = how.stop_sent_ms;
  answer["at_rest_ms"] = how.at_rest_ms;
  answer["largest_errors"] = errors;
  return answer;
}

std::unique_ptr<device::RobotEmulator> emulate(const SceneModel& scene, const std::string& kind,
                                               std::uint16_t port) {
  if (kind != "arm" && kind != "hand") {
    throw InputError({"kind", "", "\"" + kind + "\"", "arm or hand", ""});
  }
  const geometric::JointIndices variables = scene.problem().joints.of_part(kind);
  const auto at_start = [&](auto settings) {
    settings.joints = execution::device_joints(scene.robot(), variables);
    settings.position = scene.problem().start(variables);
    return settings;
  };
  if (kind == "arm") {
    return std::make_unique<device::ArmEmulator>(at_start(device::Val3ControllerSettings()), port);
  }
  return std::make_unique<device::HandEmulator>(at_start(device::HandControllerSettings()), port);
}

// Finds a file, or one that ships by its name.
fs::path mapping_file(const std::string& name) {
  const fs::path shipped = geometric::resource_dir() / "mappings" / (name + ".yaml");
  return !fs::exists(name) && fs::exists(shipped) ? shipped : fs::path(name);
}

py::dict map_recording(const py::object& file, const std::string& mapping,
                       const py::object& calibration) {
  static_cast<void>(plugin_manager());  // they read other formats of robots
  const fs::path mapped_by = mapping_file(mapping);
  const device::HandMapping wiring = device::read_mapping(mapped_by);
  const std::shared_ptr<const geometric::RobotModel> hand = geometric::load_robot(
      geometric::find_resource(geometric::ResourceKind::kRobot, wiring.hand,
                               fs::absolute(mapped_by).parent_path(), mapped_by.string()));
  const device::HandMapper mapper(wiring, *hand, true);
  const device::GloveCalibration person =
      calibration.is_none() ? device::typical_calibration()
                            : device::read_calibration(file_name_from(calibration, "calibration"));
  const device::MappedPostures mapped = mapper.map_recording(
      device::to_angles(device::read_recording(file_name_from(file, "file")), person));
  const auto rows = [](const Eigen::MatrixXd& matrix) {
    std::vector<Eigen::VectorXd> all;
    for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
      all.emplace_back(matrix.row(row).transpose());
    }
    return to_array(all, matrix.cols());
  };
  Eigen::MatrixXd normalised = mapped.postures;
  for (Eigen::Index joint = 0; joint < normalised.cols(); ++joint) {
    const double range = mapper.upper()[joint] - mapper.lower()[joint];
    if (range > 0.0) {
      normalised.col(joint) = (normalised.col(joint).array() - mapper.lower()[joint]) / range;
    } else {
      normalised.col(joint).setConstant(0.5);
    }
  }
  py::dict answer;
  answer["hand"] = wiring.hand;
  answer["joints"] = mapped.joints;
  answer["postures"] = rows(mapped.postures);
  answer["normalised"] = rows(normalised);
  return answer;
}

}  // namespace

void bind_devices(py::module_& module) {
  device::MotionTolerances tolerances;
  py::class_<RobotConnection> connection(
      module, "Connection",
      "Connection to the devices of a scene's robot. `with scene.connect(...) as robot:` stops\n"
      "and disconnects them at the end.");
  connection
      .def("run", &run, py::arg("motion"),
           ("Runs a motion to its end. Ctrl-C stops it, and so does stop() from another thread.\n\n"
            "It begins only if it is free in the scene from where the robot is measured.\n"
            "motion: a cleared one, made by Scene.time().\n" +
            keywords_text(parameters_of(tolerances)) +
            "\nReturns a dict: done, started, fault (the reason why it was not done;\n"
            "empty if it was stopped on request), time (s of the motion),\n"
            "stop_sent_ms, at_rest_ms (-1: not seen), largest_errors (rad, by joint).")
               .c_str())
      .def("stop", &RobotConnection::stop, py::call_guard<py::gil_scoped_release>(),
           "Stops all devices at once and ends a running motion. Any thread may call it.")
      .def("close", &RobotConnection::close, py::call_guard<py::gil_scoped_release>(),
           "Stops the devices and disconnects.")
      .def_property_readonly(
          "measured",
          [](RobotConnection& c) {
            geometric::Configuration q;
            {
              const py::gil_scoped_release release;
              q = c.measured();
            }
            return to_array(q);
          },
          "Measured configuration, [variables], rad or m; joints without a device are at the\n"
          "start.")
      .def("__enter__", [](py::object self) { return self; })
      .def("__exit__", [](RobotConnection& c, const py::args& /*raised*/) {
        const py::gil_scoped_release release;
        c.close();
      });
  py::class_<device::RobotEmulator> emulator(module, "Emulator",
                                             "An emulated arm or hand on a port of this computer.");
  emulator
      .def_property_readonly("address", &device::RobotEmulator::address,
                             "Address for Scene.connect().")
      .def_property_readonly(
          "position", [](const device::RobotEmulator& e) { return to_array(e.position()); },
          "Positions of its joints, [joints], rad.")
      .def_property_readonly("moving", &device::RobotEmulator::moving, "True if a joint moves.")
      .def_property_readonly("stops", &device::RobotEmulator::stops,
                             "Number of stop commands received.");
  auto scene = py::reinterpret_borrow<py::class_<SceneModel>>(module.attr("Scene"));
  scene
      .def("connect", &connect, py::arg("to"),
           "Connects to the devices of the robot, without moving them.\n\n"
           "to: arm://HOST[:PORT], hand://HOST[:PORT], both with a comma between, or\n"
           "ros://HOST[:PORT][/CONTROLLER][#arm|#hand] (ros2:// for ROS 2).")
      .def("emulate", &emulate, py::arg("kind"), py::arg("port") = 0,
           "Returns an emulated device of the robot, with its joints at the scene's start.\n\n"
           "kind: arm or hand. port: a TCP port; 0: any free one.");
  module.def(
      "map_recording", &map_recording, py::arg("file"), py::kw_only(),
      py::arg("mapping") = "table1_sah", py::arg("calibration") = py::none(),
      "Maps a recording of a person's hand to postures of a robot's hand.\n\n"
      "file: a recording of a glove or of hand landmarks, or a posture table. mapping: a\n"
      "file, or the name of a mapping that ships. calibration: a file of the person, for\n"
      "recordings of counts; None: a typical right hand. Returns a dict: hand (the robot),\n"
      "joints (names), postures [n, joints]\n"
      "(rad), normalised [n, joints] (0 to 1 between the limits, as find_pmds() takes them).");
}

}  // namespace handway::python
