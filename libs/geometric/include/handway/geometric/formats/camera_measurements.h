#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/setup/hand_eye.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// Files of measurements for the calibration of a camera, and of its result.
///
/// YAML:
///
///     camera: fixed                # or hand; only with pairs
///     pairs:                       # of poses: m
///       - hand: {xyz: [0.5, 0.1, 0.4], rpy_deg: [180, 0, 90]}
///         target: {xyz: [0.02, -0.1, 0.6], quaternion: [0, 0, 0, 1]}   # x, y, z, w
///       - hand: {xyz: …, rotation_vector: [2.2, -2.2, 0]}              # rad
///         target: …
///     points:                      # instead of pairs
///       - {robot: [0.5, 0.1, 0.2], camera: [0.05, 0.02, 0.8]}
///
/// Tables of text have the same values in columns with these names in any order: `hand_x`,
/// `hand_y`, `hand_z`, and `hand_roll_deg`, `hand_pitch_deg`, `hand_yaw_deg`, or `hand_qx`,
/// `hand_qy`, `hand_qz`, `hand_qw`, or `hand_rx`, `hand_ry`, `hand_rz`; `target_…` alike; or
/// `robot_x` … and `camera_x` ….

namespace handway::geometric {

/// Measurements of a camera.
struct CameraMeasurements {
  std::optional<CameraMount> mount;  ///< If the file names it.
  std::vector<HandEyePair> pairs;
  std::vector<TouchedPoint> points;  ///< Without pairs.
};

/// Reads measurements; the ending decides: `.yaml` and `.yml`, else a table.
/// @throws InputError with file, line and element if the file is neither, has neither pairs nor
/// points, or has numbers that are no pose in m.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT CameraMeasurements
read_camera_measurements(const std::filesystem::path& file);

/// Returns a calibration as YAML: the camera's pose as in scene files, residuals in mm and degrees.
/// @param mount nothing: of points.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string camera_calibration_text(
    const CameraCalibration& calibration, const std::optional<CameraMount>& mount);

}  // namespace handway::geometric
