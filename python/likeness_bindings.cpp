#include "arrays.h"
#include "bindings.h"
#include "handway/device/retargeting/workspace_overlap.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/queries/dynamic_time_warping.h"
#include "handway/planning/queries/motion_likeness.h"
#include "handway/sampling/postures/posture_table.h"
#include "scene_model.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace py = pybind11;

namespace handway::python {
namespace {

using geometric::InputError;
using planning::MovementSmoothness;

py::object smoothness_dict(const std::optional<MovementSmoothness>& smoothness) {
  if (!smoothness) {
    return py::none();
  }
  py::dict answer;
  answer["log_dimensionless_jerk"] = smoothness->log_dimensionless_jerk;
  answer["spectral_arc_length"] = smoothness->spectral_arc_length;
  return answer;
}

py::object deviation_dict(const std::optional<planning::StraightDeviation>& deviation) {
  if (!deviation) {
    return py::none();
  }
  py::dict answer;
  answer["arm"] = deviation->arm;
  answer["palm_mm"] = geometric::millimetres(deviation->palm);
  return answer;
}

py::object components_dict(const std::optional<planning::ComponentError>& error,
                           const std::string& recordings) {
  if (!error) {
    return py::none();
  }
  py::dict answer;
  answer["error_rad"] = error->error;
  answer["recorded_median_rad"] = error->recorded_median;
  answer["recorded_95_rad"] = error->recorded_95;
  answer["motions"] = error->motions;
  answer["components"] = error->components;
  answer["recordings"] = recordings;
  return answer;
}

// Postures of a file, or those that the basis names; null if there are none.
std::shared_ptr<const sampling::RecordedPostures> recorded_postures(
    const planning::PlanningProblem& problem, const py::object& file) {
  if (file.is_none()) {
    return problem.basis ? sampling::load_recorded_postures(*problem.basis) : nullptr;
  }
  if (!problem.basis) {
    throw InputError({"postures", "", "a scene without a hand basis",
                      "a basis with the joints of the postures", "Name one in load_scene()."});
  }
  return sampling::load_recorded_postures(*problem.basis, file_name_from(file, "postures"));
}

py::array_t<double> array_of(const Eigen::MatrixXd& motion) {
  std::vector<Eigen::VectorXd> rows;
  for (const auto& row : motion.rowwise()) {
    rows.emplace_back(row.transpose());
  }
  return to_array(rows, motion.cols());
}

py::dict measure_motion(const SceneModel& scene, const Array& array, const py::object& postures) {
  const planning::PlanningProblem& problem = scene.problem();
  const planning::Path path{batch_from(array, scene.robot().variable_count(), "path").rows};
  const auto recorded = recorded_postures(problem, postures);
  std::variant<planning::Trajectory, std::string> timed;
  run_interruptible([&](const std::stop_token& stop) {
    timed = planning::likeness_trajectory(problem, path, stop);
  });
  const auto* trajectory = std::get_if<planning::Trajectory>(&timed);
  if (trajectory == nullptr) {
    throw InputError({"path", "", std::get<std::string>(timed), "a path that can be timed", ""});
  }
  const planning::MotionLikeness likeness =
      planning::motion_likeness(problem, *trajectory, recorded.get());
  py::dict answer;
  answer["duration_s"] = likeness.duration;
  answer["hand"] = smoothness_dict(likeness.hand);
  answer["palm"] = smoothness_dict(likeness.palm);
  answer["deviation"] = deviation_dict(likeness.deviation);
  answer["components"] =
      components_dict(likeness.components, recorded ? recorded->source() : std::string());
  answer["no_components"] = likeness.no_components;
  answer["motion"] = array_of(planning::comparable_motion(problem, *trajectory));
  return answer;
}

py::object smoothness(const Array& speed, double period) {
  const Eigen::VectorXd speeds =
      vector_from(speed, speed.ndim() == 1 ? speed.shape(0) : 0, "speed");
  if (!(period > 0.0) || !std::isfinite(period)) {
    throw InputError({"period", "", fmt::format("{}", period), "a number of seconds above 0", ""});
  }
  return smoothness_dict(planning::movement_smoothness({period, speeds}));
}

// The points of a motion, one a row.
Eigen::MatrixXd points_from(const Array& array, const char* argument) {
  const Eigen::Index joints = array.ndim() == 2 ? array.shape(1) : 0;
  const Batch batch = batch_from(array, joints, argument);
  if (array.ndim() != 2 || batch.rows.empty() || joints == 0) {
    throw InputError({argument, "", "no points", "an array [points, joints]", ""});
  }
  Eigen::MatrixXd points(std::ssize(batch.rows), joints);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    points.row(i) = batch.rows[static_cast<std::size_t>(i)].transpose();
  }
  return points;
}

double motion_distance(const Array& a, const Array& b) {
  const Eigen::MatrixXd first = points_from(a, "a");
  const Eigen::MatrixXd second = points_from(b, "b");
  if (first.cols() != second.cols()) {
    throw InputError({"b", "", fmt::format("{} joints", second.cols()),
                      fmt::format("{} joints as in a", first.cols()), ""});
  }
  return planning::warped_distance(first, second);
}

py::dict anthropomorphism(const SceneModel& scene) {
  device::RetargetingSettings only_kinematics;
  only_kinematics.self_collision = false;
  const device::WorkspaceOverlap overlap = device::workspace_overlap(
      device::FingertipRetargeter(scene.scene().robots.front().model, only_kinematics));
  py::list fingers;
  for (const device::FingertipOverlap& finger : overlap.fingers) {
    py::dict entry;
    entry["finger"] = device::name_of(finger.finger);
    entry["coverage"] = finger.coverage();
    entry["human_share"] = finger.human_share();
    fingers.append(std::move(entry));
  }
  py::dict answer;
  answer["coverage"] = overlap.coverage();
  answer["fingers"] = std::move(fingers);
  return answer;
}

}  // namespace

void bind_likeness(py::module_& module) {
  auto scene = py::reinterpret_borrow<py::class_<SceneModel>>(module.attr("Scene"));
  scene.def(
      "measure_motion", &measure_motion, py::arg("path"), py::kw_only(),
      py::arg("postures") = py::none(),
      "Returns measures of the motion along a path, timed with limited jerk at full speed.\n\n"
      "path: [waypoints, variables], rad or m. postures: file of recorded postures to compare\n"
      "the hand with; default: those that the hand basis names.\n"
      "Returns a dict with the keys of `motion` in `handway plan --report`: duration_s; hand and\n"
      "palm, dicts of log_dimensionless_jerk (Hogan and Sternad 2009) and spectral_arc_length\n"
      "(Balasubramanian et al. 2015), nearer to 0 for smoother motions; deviation, a dict of the\n"
      "largest distances from the straight motion, arm (normalised joints) and palm_mm;\n"
      "components, a dict of the hand's error by functional principal components of recorded\n"
      "motions, error_rad, and the same of recorded motions, recorded_median_rad and\n"
      "recorded_95_rad; no_components, a reason why there are none. None for what doesn't apply.\n"
      "motion: 50 points at even times, [50, joints], for motion_distance().");
  scene.def(
      "anthropomorphism", &anthropomorphism,
      "Returns how far the fingertips of the first robot's hand reach where those of a human\n"
      "hand do (in the manner of Liarokapis, Artemiadis and Kyriakopoulos, \"Quantifying\n"
      "anthropomorphism of robot hands\", ICRA 2013).\n\n"
      "Returns a dict of coverage, the mean share of the workspaces of a human hand's five\n"
      "fingertips that the robot's reach, in [0, 1]; and fingers, a list of dicts of finger,\n"
      "coverage and human_share, the share of the robot's workspace that is human.");
  module.def(
      "movement_smoothness", &smoothness, py::arg("speed"), py::arg("period"),
      "Returns the smoothness of a movement from rest to rest, or None without movement.\n\n"
      "speed: [samples], at least 0, in any unit. period: time between samples, s.\n"
      "Returns a dict of log_dimensionless_jerk (-5.32 for a minimum-jerk movement; Hogan and\n"
      "Sternad 2009) and spectral_arc_length (about -1.4; SPARC, Balasubramanian et al. 2015).");
  module.def("motion_distance", &motion_distance, py::arg("a"), py::arg("b"),
             "Returns the distance of two motions by dynamic time warping (Sakoe and Chiba 1978):\n"
             "the mean distance of matched points.\n\n"
             "a, b: points in order of time, [points, joints].");
}

}  // namespace handway::python
