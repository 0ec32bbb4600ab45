#include "arrays.h"
#include "bindings.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/setup/hand_eye.h"
#include "scene_questions.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <string>
#include <vector>

namespace py = pybind11;

namespace handway::python {
namespace {

using geometric::CameraCalibration;
using geometric::InputError;
using geometric::Pose;

/// Poses of an array [n, 4, 4].
std::vector<Pose> poses_from(const Array& array, const std::string& argument) {
  if (array.ndim() != 3 || array.shape(1) != 4 || array.shape(2) != 4) {
    throw InputError({argument, "", "another shape", "poses [n, 4, 4]", ""});
  }
  std::vector<Pose> poses;
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    poses.push_back(pose_from(Array({4, 4}, array.data(i)), fmt::format("{}[{}]", argument, i)));
  }
  return poses;
}

void check_alike(std::size_t first, std::size_t second, const char* argument) {
  if (first != second) {
    throw InputError({argument, "", std::to_string(second),
                      fmt::format("{}, one for each of the robot", first), ""});
  }
}

geometric::CameraCalibrationSettings settings_of(bool outliers) {
  geometric::CameraCalibrationSettings settings;
  settings.leaves_out_outliers = !outliers;
  return settings;
}

py::dict calibration_dict(const CameraCalibration& calibration, bool has_target) {
  const auto count = static_cast<Eigen::Index>(calibration.residuals.size());
  Eigen::VectorXd positions(count);
  Eigen::VectorXd angles(count);
  py::list outliers;
  for (Eigen::Index i = 0; i < count; ++i) {
    const geometric::CalibrationResidual& residual =
        calibration.residuals[static_cast<std::size_t>(i)];
    positions[i] = residual.position;
    angles[i] = residual.angle;
    if (residual.is_outlier) {
      outliers.append(i);
    }
  }
  py::dict result;
  result["pose"] = pose_array(calibration.X_AC);
  result["rms_position"] = calibration.rms_position;
  result["position_residuals"] = to_array(positions);
  if (has_target) {
    result["target"] = pose_array(calibration.X_target);
    result["rms_angle"] = calibration.rms_angle;
    result["angle_residuals"] = to_array(angles);
  }
  result["outliers"] = outliers;
  return result;
}

py::dict calibrate_camera(const Array& hand, const Array& target, const std::string& mount,
                          bool outliers) {
  if (mount != "hand" && mount != "fixed") {
    throw InputError({"mount", "", '"' + mount + '"', "hand or fixed", ""});
  }
  const std::vector<Pose> hands = poses_from(hand, "hand");
  const std::vector<Pose> targets = poses_from(target, "target");
  check_alike(hands.size(), targets.size(), "target");
  std::vector<geometric::HandEyePair> pairs;
  for (std::size_t i = 0; i < hands.size(); ++i) {
    pairs.push_back({hands[i], targets[i], std::to_string(i)});
  }
  return calibration_dict(
      geometric::calibrate_hand_eye(
          pairs, mount == "hand" ? geometric::CameraMount::kOnHand : geometric::CameraMount::kFixed,
          settings_of(outliers)),
      true);
}

py::dict calibrate_camera_by_points(const Array& robot, const Array& camera, bool outliers) {
  const Batch of_robot = batch_from(robot, 3, "robot");
  const Batch of_camera = batch_from(camera, 3, "camera");
  check_alike(of_robot.rows.size(), of_camera.rows.size(), "camera");
  std::vector<geometric::TouchedPoint> points;
  for (std::size_t i = 0; i < of_robot.rows.size(); ++i) {
    points.push_back({of_robot.rows[i], of_camera.rows[i], std::to_string(i)});
  }
  return calibration_dict(geometric::calibrate_camera_by_points(points, settings_of(outliers)),
                          false);
}

}  // namespace

void bind_calibration(py::module_& module) {
  module.def(
      "calibrate_camera", &calibrate_camera, py::arg("hand"), py::arg("target"), py::kw_only(),
      py::arg("mount") = "hand", py::arg("outliers") = false,
      "Returns the pose of a camera from poses of the hand and of a target that it sees.\n\n"
      "hand: poses of the hand in the robot's base, [n, 4, 4]. target: poses of the target in the\n"
      "camera, [n, 4, 4]. mount: \"hand\", with a target that stands still, or \"fixed\", with "
      "the\n"
      "target on the hand. outliers: use all pairs, also those that contradict the others.\n"
      "Returns a dict of pose, of the camera in the hand or the base; target, its pose in the "
      "base\n"
      "or the hand; rms_position (m), rms_angle (rad); position_residuals and angle_residuals, "
      "[n];\n"
      "and outliers, the pairs that were not used.");
  module.def(
      "calibrate_camera_by_points", &calibrate_camera_by_points, py::arg("robot"),
      py::arg("camera"), py::kw_only(), py::arg("outliers") = false,
      "Returns the pose of a camera from points that the robot touched and the camera saw.\n\n"
      "robot, camera: the points in the robot's frame and the camera's, m, [n, 3]. outliers: use\n"
      "all points, also those that contradict the others.\n"
      "Returns a dict of pose, of the camera in the robot's frame; rms_position (m);\n"
      "position_residuals, [n]; and outliers, the points that were not used.");
}

}  // namespace handway::python
