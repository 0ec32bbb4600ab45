#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/recording.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// A person's hand, and a glove on it: a straight line from raw counts to joint angles for every
/// sensor, the joints' ranges, and the bones' lengths. All but `sensors` may be left out, and that
/// too if there are ranges or bones: the lines are then those of a typical hand.
///
///     person: typical right hand
///     date: 2026-03-01
///     source: "where the numbers come from"
///     sensors:
///       ThumbRotate: {gain: 0.01584, zero: 90}
///       ThumbMPJ: {gain: 0.01459, zero: 88, residual: 0.02}   # residual: optional
///     ranges:                       # degrees, least and most
///       IndexMPJ: [-12, 83]
///     bones:                        # mm, from the wrist outwards
///       thumb: [32, 48, 37, 30]

namespace handway::device {

/// angle = gain · (counts - zero).
struct SensorCalibration {
  double gain = 0.0;               ///< rad per count; negative where bending lowers the counts.
  double zero = 0.0;               ///< Counts at 0 rad.
  std::optional<double> residual;  ///< Root mean square error of the fit, rad.
};

/// Ranges of a person's joint angles, rad: (least, most); none if unknown.
using PersonRanges = std::array<std::optional<std::pair<double, double>>, kGloveSensors>;

/// The calibration of one glove on one person's hand.
struct GloveCalibration {
  std::string person;
  std::string date;    ///< ISO 8601; may be empty.
  std::string source;  ///< Method of calibration; may be empty.
  /// Calibrations of cyberglove_sensors(); empty for uncalibrated sensors.
  std::array<std::optional<SensorCalibration>, kGloveSensors> sensors;
  PersonRanges ranges;
  std::optional<HandBones> bones;
};

/// Reads a calibration; the content decides the kind of file:
///   - YAML as above;
///   - text with 22 lines `angle:counts angle:counts`, from the wrist to the little finger, a
///     straight line through two points each (rad, signs of VirtualHand, which are converted);
///   - text with a title, then six groups (thumb … little finger, wrist) of a name and four lines
///     `index zero gain x` (VirtualHand; angle = gain · (counts - zero), its signs are converted).
///     A gain of 0 leaves the sensor uncalibrated.
///
/// @throws geometric::InputError with file and line for a file of another kind, an unknown sensor
/// or finger, a missing line, a gain of 0, two points less than 10 counts apart, a range that does
/// not rise, or bones that are not positive.
[[nodiscard]] HANDWAY_DEVICE_EXPORT GloveCalibration
read_calibration(const std::filesystem::path& file);

/// Writes YAML, the file replaced whole.
/// @throws geometric::InputError if it can't be written.
HANDWAY_DEVICE_EXPORT void write_calibration(const GloveCalibration& calibration,
                                             const std::filesystem::path& file);

/// Generic calibration: resources/calibrations/typical_right_hand.yaml.
/// @throws geometric::InputError if the library lacks it.
[[nodiscard]] HANDWAY_DEVICE_EXPORT GloveCalibration typical_calibration();

/// The angles of a frame; NaN for sensors that are missing (0 counts) or not calibrated. Angles
/// that the source measured itself are returned unchanged.
[[nodiscard]] HANDWAY_DEVICE_EXPORT GloveAngles to_angles(const GloveFrame& frame,
                                                          const GloveCalibration& calibration);

/// The frame that a glove with this calibration measures at these angles: rounded and limited to 1
/// 255; 0 for angles that are NaN and sensors that are not calibrated.
[[nodiscard]] HANDWAY_DEVICE_EXPORT GloveFrame to_counts(const GloveAngles& angles,
                                                         const GloveCalibration& calibration);

/// A recording of counts as angles, without the sensors that are not calibrated (a warning names
/// them). A recording of angles is returned unchanged.
[[nodiscard]] HANDWAY_DEVICE_EXPORT Recording to_angles(const Recording& recording,
                                                        const GloveCalibration& calibration);

}  // namespace handway::device
