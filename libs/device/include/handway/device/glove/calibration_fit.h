#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/angle_ranges.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/recording.h"

#include <array>
#include <string>
#include <vector>

/// Methods of calibrating a glove for a hand.

namespace handway::device {

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

/// Maps each sensor's 1st and 99th percentile of a free motion to the ends of its joint's
/// range. The gain's sign is that of `signs` (a sensor's calibration before): the counts alone
/// don't determine which end is which. A sensor with a range below 10 counts keeps that
/// calibration.
/// @throws geometric::InputError if the recording holds no counts.
[[nodiscard]] HANDWAY_DEVICE_EXPORT CalibrationFit calibrate_from_range(
    const Recording& counts, const AngleRanges& ranges, const GloveCalibration& signs,
    const std::string& person, const std::string& date);

}  // namespace handway::device
