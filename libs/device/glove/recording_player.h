#pragma once

#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/recording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace handway::device {

/// Reading of a sensor without calibration, or of one that a recording doesn't have.
inline constexpr double kMidScale = 128.0;

/// Reading of a sensor for an angle (rad), before rounding.
[[nodiscard]] inline double counts_of(const std::optional<SensorCalibration>& sensor,
                                      double angle) {
  return sensor ? sensor->zero + angle / sensor->gain : kMidScale;
}

/// Rounds, and clamps to the range of a sensor: 1 to 255.
[[nodiscard]] inline std::uint16_t to_count(double value) {
  return static_cast<std::uint16_t>(std::clamp(std::round(value), 1.0, 255.0));
}

/// The frames of a recording as counts, with their times.
class RecordingPlayer {
 public:
  /// Angles become counts by `calibration`; all counts are clamped to 1 … 255, and sensors missing
  /// in the recording are 0.
  /// @throws geometric::InputError if the recording has no rows.
  RecordingPlayer(const Recording& recording, const GloveCalibration& calibration);

  [[nodiscard]] std::size_t size() const { return frames_.size(); }
  /// Time since the first frame, s.
  [[nodiscard]] const GloveFrame& frame(std::size_t index) const { return frames_[index]; }
  /// Mean time from one frame to the next, s; 0.01 for a single frame.
  [[nodiscard]] double period() const { return period_; }
  /// Period from the first frame of one round to the first of the next, s.
  [[nodiscard]] double duration() const { return frames_.back().time + period_; }
  /// The last frame that isn't after `time`. @param time s, 0 to duration().
  [[nodiscard]] const GloveFrame& frame_at(double time) const;

 private:
  std::vector<GloveFrame> frames_;
  double period_ = 0.01;
};

}  // namespace handway::device
