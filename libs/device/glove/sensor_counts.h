#pragma once

#include "handway/device/glove/glove_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace handway::device {

/// What a sensor without calibration, or one that a recording doesn't have, reads.
inline constexpr double kMidScale = 128.0;

/// What a sensor reads for an angle (rad), before rounding.
[[nodiscard]] inline double counts_of(const std::optional<SensorCalibration>& sensor,
                                      double angle) {
  return sensor ? sensor->zero + angle / sensor->gain : kMidScale;
}

/// Rounded, and brought to what a sensor can read: 1 to 255.
[[nodiscard]] inline std::uint16_t to_count(double value) {
  return static_cast<std::uint16_t>(std::clamp(std::round(value), 1.0, 255.0));
}

}  // namespace handway::device
