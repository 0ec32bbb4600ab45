#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/pose.h"

#include <span>
#include <string>
#include <vector>

/// Hand-eye calibration: the pose of a camera on a robot's hand, or of a camera that looks at the
/// robot from a fixed place.
///
/// The frames: B is the base of the robot, H its hand (flange or palm), C the camera, T a target
/// that the camera sees, such as a chessboard.

namespace handway::geometric {

/// Place of a camera.
enum class CameraMount {
  kOnHand,  ///< On the hand, which moves; the target stands still ("eye in hand").
  kFixed,   ///< At a fixed place; the target is on the hand ("eye to hand").
};

/// Measurement of one posture of the robot.
struct HandEyePair {
  Pose X_BH = Pose::Identity();  ///< From the robot's joints.
  Pose X_CT = Pose::Identity();  ///< From the camera's image.
  std::string place;             ///< Name for messages: "pairs.csv:7".
};

/// A point that the robot touched with the tip of its tool, and the camera saw.
struct TouchedPoint {
  Eigen::Vector3d p_A = Eigen::Vector3d::Zero();  ///< From the robot, in the frame A, m.
  Eigen::Vector3d p_C = Eigen::Vector3d::Zero();  ///< From the camera, m.
  std::string place;                              ///< Name for messages.
};

/// Deviation of one measurement from the calibration.
struct CalibrationResidual {
  std::string place;
  double position = 0.0;    ///< m.
  double angle = 0.0;       ///< rad; 0 for points.
  bool is_outlier = false;  ///< The measurement was not used.
};

/// Pose of a camera, with the deviations of all measurements.
struct CameraCalibration {
  /// Pose of the camera in the hand's frame (kOnHand) or the base's (kFixed); of points in theirs.
  Pose X_AC = Pose::Identity();
  /// Pose of the target in the base's frame (kOnHand) or the hand's (kFixed). Identity for points.
  Pose X_target = Pose::Identity();
  std::vector<CalibrationResidual> residuals;  ///< One for each measurement, in their order.
  double rms_position = 0.0;                   ///< m, of the measurements that were used.
  double rms_angle = 0.0;                      ///< rad, of the measurements that were used.
  int used = 0;                                ///< Number of measurements that are no outliers.
};

/// Properties of a calibration.
struct CameraCalibrationSettings {
  /// Leave out measurements that contradict the others; otherwise all are used.
  bool leaves_out_outliers = true;
  /// Names of the file or the source, for messages.
  std::string source = "calibration";
};

/// Solves AX = XB for the pose of the camera, where A are the motions of the hand between two
/// postures and B those of the target in the camera, by the method of F. C. Park and B. J. Martin,
/// "Robot sensor calibration: solving AX = XB on the Euclidean group", IEEE Transactions on
/// Robotics and Automation 10(5), 1994. The residual of a pair is the deviation of the target's
/// pose from its mean over all pairs that are used. Of five pairs or more, those are outliers that
/// deviate by more than 4.4 times the median deviation, and a share for small numbers, from the fit
/// with the least median of squares: half of the pairs may be wrong. Equal input gives equal bits.
/// @throws InputError if there are fewer than three pairs, or the hand turned too little, or about
/// parallel axes: the position of the camera along them is then not determined.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT CameraCalibration
calibrate_hand_eye(std::span<const HandEyePair> pairs, CameraMount mount,
                   const CameraCalibrationSettings& settings = {});

/// Finds the pose of the camera in the frame A by the least squares of S. Umeyama, "Least-squares
/// estimation of transformation parameters between two point patterns", IEEE Transactions on
/// Pattern Analysis and Machine Intelligence 13(4), 1991, without a scale. Outliers as those of
/// calibrate_hand_eye().
/// @throws InputError if there are fewer than three points, they lie on a line, or the extents of
/// both sets differ by more than a quarter (different units).
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT CameraCalibration calibrate_camera_by_points(
    std::span<const TouchedPoint> points, const CameraCalibrationSettings& settings = {});

}  // namespace handway::geometric
