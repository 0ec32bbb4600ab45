#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/recording.h"

#include <array>
#include <utility>

/// Ranges of motion of typical hands and of persons.

namespace handway::device {

/// Angles that a hand's joints go through when it moves as far as it can, rad: (least, most).
using AngleRanges = std::array<std::pair<double, double>, kGloveSensors>;

/// Rounded ranges of adult hands: the input of min-max calibration if nothing is measured.
[[nodiscard]] HANDWAY_DEVICE_EXPORT const AngleRanges& typical_angle_ranges();

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
