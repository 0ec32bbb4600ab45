#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/recording.h"

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

/// Postures for the guided calibration of a glove, as YAML:
///
///     poses:
///       - name: flat
///         instruction: "Lay the hand flat on a table."
///         degrees: {IndexMPJ: 0, IndexPIJ: 0}
///       - name: motion
///         motion: 10                # s: the hand moves, and shows how far its joints go
///         instruction: "Open the hand and make a fist, some times."
///         degrees: {IndexMPJ: 75}   # for the picture

/// Methods of calibrating a glove for a hand.

namespace handway::device {

/// Instruction to take a posture, with its angles.
struct PoseInstruction {
  std::string name;
  std::string instruction;                   ///< One sentence; may be empty.
  std::array<double, kGloveSensors> angles;  ///< rad; NaN for sensors that the pose leaves open.
  double motion = 0.0;                       ///< s that the hand moves; 0: it is held.
};

/// @throws geometric::InputError with file, line and key for an unknown sensor, a name twice, no
/// poses, or a pose without angles.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::vector<PoseInstruction> read_guided_poses(
    const std::filesystem::path& file);

/// A calibration with its doubts: sensors that are dead (hardly moved), noisy, or at an end of
/// their range; fits that are bad.
struct CalibrationFit {
  GloveCalibration calibration;
  std::vector<std::string> warnings;
};

/// A guided posture, and the glove's readings during it.
struct GuidedPose {
  std::string name;                          ///< "flat hand".
  std::array<double, kGloveSensors> angles;  ///< rad, flexion positive; NaN: unknown.
  Recording counts;                          ///< While the posture was held; kCounts.
};

/// Fits each sensor's line by least squares to the means of the poses that define its angle. A
/// sensor gets no calibration if fewer than two different angles are known for it or its means
/// differ by less than 10 counts. Residuals above 0.1 rad give a warning.
/// @throws geometric::InputError without poses, or if one holds angles instead of counts.
[[nodiscard]] HANDWAY_DEVICE_EXPORT CalibrationFit calibrate_from_poses(
    const std::vector<GuidedPose>& poses, const std::string& person, const std::string& date);

/// Angles that a hand's joints go through when it moves as far as it can, rad: (least, most).
using AngleRanges = std::array<std::pair<double, double>, kGloveSensors>;

/// Rounded ranges of adult hands: the input of min-max calibration if nothing is measured.
[[nodiscard]] HANDWAY_DEVICE_EXPORT const AngleRanges& typical_angle_ranges();

/// Maps each sensor's 1st and 99th percentile of a free motion to the ends of its joint's
/// range. The gain's sign is that of `signs` (a sensor's calibration before): the counts alone
/// don't determine which end is which. A sensor with a range below 10 counts keeps that
/// calibration.
/// @throws geometric::InputError if the recording holds no counts.
[[nodiscard]] HANDWAY_DEVICE_EXPORT CalibrationFit calibrate_from_range(
    const Recording& counts, const AngleRanges& ranges, const GloveCalibration& signs,
    const std::string& person, const std::string& date);

/// Returns a person's ranges of motion: each sensor's 1st and 99th percentile of a free motion;
/// none of sensors that moved by less than 5°.
/// @throws geometric::InputError if the recording holds counts.
[[nodiscard]] HANDWAY_DEVICE_EXPORT PersonRanges measured_ranges(const Recording& angles);

/// The angle of a typical hand at the same share of its range as a person's angle in the person's
/// own range: 0 stays 0, and each side of it is scaled, if it is wider than 5°. An unknown range
/// changes nothing.
/// @param sensor index into cyberglove_sensors(). @param angle rad.
[[nodiscard]] HANDWAY_DEVICE_EXPORT double typical_angle(const PersonRanges& ranges, int sensor,
                                                         double angle);

}  // namespace handway::device
