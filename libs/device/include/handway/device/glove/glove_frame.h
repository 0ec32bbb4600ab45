#pragma once

#include <array>
#include <cstdint>

namespace handway::device {

/// How many sensors every frame has room for: those of cyberglove_sensors().
inline constexpr int kGloveSensors = 22;

/// What a glove measured at one time. A glove with fewer sensors leaves those it
/// doesn't have at 0, which no sensor ever reads.
struct GloveFrame {
  double time = 0.0;  ///< s since the stream began, on a steady clock.
  std::array<std::uint16_t, kGloveSensors> counts{};  ///< Raw, 1 … 255.
};

/// The angles of one frame after calibration.
struct GloveAngles {
  double time = 0.0;  ///< s, as in the frame.
  std::array<double, kGloveSensors>
      angles{};  ///< rad, flexion positive; NaN where there is no sensor.
};

}  // namespace handway::device
