#pragma once

#include "handway/device/glove/emulated_response.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace handway::device {

/// What a sensor reads for an angle (rad), before rounding.
[[nodiscard]] inline double counts_of(const SensorResponse& response, double angle) {
  return response.zero + angle / response.gain;
}

/// Rounded, and brought to what a sensor can read: 1 to 255.
[[nodiscard]] inline std::uint16_t to_count(double value) {
  return static_cast<std::uint16_t>(std::clamp(std::round(value), 1.0, 255.0));
}

}  // namespace handway::device
