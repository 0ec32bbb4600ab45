#include "commands.h"
#include "handway/geometric/formats/camera_measurements.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/setup/hand_eye.h"
#include "printing.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using geometric::CalibrationResidual;
using geometric::CameraCalibration;
using geometric::CameraMeasurements;
using geometric::CameraMount;
using geometric::Pose;
using Json = nlohmann::ordered_json;

struct CalibrateOptions {
  fs::path measurements;
  fs::path out;
  std::string mount;
  bool keeps_outliers = false;
  bool as_json = false;
};

/// The place of the camera; nothing for points.
std::optional<CameraMount> mount_of(const CalibrateOptions& options,
                                    const CameraMeasurements& measurements) {
  if (!measurements.points.empty()) {
    return std::nullopt;
  }
  if (!options.mount.empty()) {
    return options.mount == "hand" ? CameraMount::kOnHand : CameraMount::kFixed;
  }
  if (!measurements.mount) {
    throw geometric::InputError({options.measurements.string(), "camera", "nothing",
                                 "hand or fixed", "Give --mount hand or --mount fixed."});
  }
  return measurements.mount;
}

CameraCalibration calibrated(const CalibrateOptions& options,
                             const CameraMeasurements& measurements,
                             const std::optional<CameraMount>& mount) {
  geometric::CameraCalibrationSettings settings;
  settings.source = options.measurements.string();
  settings.leaves_out_outliers = !options.keeps_outliers;
  return mount ? geometric::calibrate_hand_eye(measurements.pairs, *mount, settings)
               : geometric::calibrate_camera_by_points(measurements.points, settings);
}

std::string pose_words(const Pose& X) {
  const Eigen::Vector3d p = X.translation();
  const Eigen::Vector3d rpy = geometric::rpy_from_rotation(X.linear()) / geometric::kDegree;
  return fmt::format("--xyz {:.5f} {:.5f} {:.5f} --rpy-deg {:.4f} {:.4f} {:.4f}", p.x(), p.y(),
                     p.z(), rpy.x(), rpy.y(), rpy.z());
}

std::string mean_words(const CameraCalibration& calibration, bool has_angles) {
  std::string text = fmt::format("{:.3f} mm", calibration.rms_position / geometric::kMillimetre);
  if (has_angles) {
    text += fmt::format(", {:.3f} deg", calibration.rms_angle / geometric::kDegree);
  }
  return text;
}

void print_calibration(const CameraCalibration& calibration,
                       const std::optional<CameraMount>& mount) {
  const bool on_hand = mount == CameraMount::kOnHand;
  const auto count = calibration.residuals.size();
  print_out("camera in the {}: {}\n",
            !mount    ? "robot's frame"
            : on_hand ? "hand's frame"
                      : "base's frame",
            pose_words(calibration.X_AC));
  if (mount) {
    print_out("target in the {}: {}\n", on_hand ? "base's frame" : "hand's frame",
              pose_words(calibration.X_target));
  }
  print_out("{}, {} used, root mean square {}\n",
            geometric::plural(count, mount ? "pose pair" : "point"), calibration.used,
            mean_words(calibration, mount.has_value()));
  for (const CalibrationResidual& residual : calibration.residuals) {
    print_out("  {}: {:.3f} mm{}{}\n", residual.place, residual.position / geometric::kMillimetre,
              mount ? fmt::format(", {:.3f} deg", residual.angle / geometric::kDegree) : "",
              residual.is_outlier ? "  outlier, not used" : "");
  }
}

Json pose_json(const Pose& X) {
  const Eigen::Vector3d p = X.translation();
  const Eigen::Vector3d rpy = geometric::rpy_from_rotation(X.linear()) / geometric::kDegree;
  return {{"xyz", {p.x(), p.y(), p.z()}}, {"rpy_deg", {rpy.x(), rpy.y(), rpy.z()}}};
}

void print_json(const CameraCalibration& calibration, const std::optional<CameraMount>& mount) {
  Json json{{"pose", pose_json(calibration.X_AC)},
            {"used", calibration.used},
            {"rms_mm", calibration.rms_position / geometric::kMillimetre}};
  if (mount) {
    json["camera"] = *mount == CameraMount::kOnHand ? "hand" : "fixed";
    json["target"] = pose_json(calibration.X_target);
    json["rms_deg"] = calibration.rms_angle / geometric::kDegree;
  }
  Json& residuals = json["residuals"] = Json::array();
  for (const CalibrationResidual& residual : calibration.residuals) {
    Json& one = residuals.emplace_back(Json::object());
    one["place"] = residual.place;
    one["mm"] = residual.position / geometric::kMillimetre;
    if (mount) {
      one["deg"] = residual.angle / geometric::kDegree;
    }
    one["outlier"] = residual.is_outlier;
  }
  print_out("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
}

int calibrate_camera(const CalibrateOptions& options) {
  const CameraMeasurements measurements = geometric::read_camera_measurements(options.measurements);
  const std::optional<CameraMount> mount = mount_of(options, measurements);
  const CameraCalibration calibration = calibrated(options, measurements, mount);
  if (!options.out.empty()) {
    geometric::replace_file(options.out, geometric::camera_calibration_text(calibration, mount));
  }
  if (options.as_json) {
    print_json(calibration, mount);
  } else {
    print_calibration(calibration, mount);
  }
  return kDone;
}

}  // namespace

void add_calibrate_command(CLI::App& app, int& exit_code) {
  CLI::App* calibrate = app.add_subcommand("calibrate", "Calibrate a camera on or at the robot");
  calibrate->require_subcommand(1);
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* camera = calibrate->add_subcommand(
      "camera", "Find the pose of a camera from poses of hand and target, or from touched points");
  camera
      ->add_option("measurements", options->measurements,
                   "Pairs of poses or of points, as YAML or a table")
      ->required();
  camera
      ->add_option("--mount", options->mount,
                   "Place of the camera: hand, or fixed with the target on the hand (default: as "
                   "the file says)")
      ->check(CLI::IsMember({"hand", "fixed"}));
  camera->add_flag("--keep-outliers", options->keeps_outliers, "Use all measurements");
  camera->add_option("--out", options->out, "Calibration to write (YAML)");
  camera->add_flag("--json", options->as_json, "Print JSON");
  camera->callback([options, &exit_code] { exit_code = calibrate_camera(*options); });
}

}  // namespace handway::tools
