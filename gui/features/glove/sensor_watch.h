#pragma once

#include "handway/device/glove/glove_frame.h"

#include <array>
#include <cstdint>

namespace handway::gui {

/// What can be told of a glove's sensors while they are used.
class SensorWatch {
 public:
  enum class Verdict {
    kGood,
    kMissing,    ///< Not on this glove.
    kSaturated,  ///< At an end of its range for most of the last moments.
    kDead,       ///< Has not moved, though others have.
  };

  struct Sensor {
    std::uint16_t counts = 0;
    std::uint16_t least = 0;  ///< Since the beginning.
    std::uint16_t most = 0;
    double at_end = 0.0;  ///< Share of the recent frames at 1 or 255.
    Verdict verdict = Verdict::kMissing;
  };

  void restart() { *this = {}; }
  void take(const device::GloveFrame& frame);

  [[nodiscard]] const std::array<Sensor, device::kGloveSensors>& sensors() const {
    return sensors_;
  }

 private:
  [[nodiscard]] int moving() const;

  std::array<Sensor, device::kGloveSensors> sensors_{};
  double first_time_ = -1.0;
};

}  // namespace handway::gui
