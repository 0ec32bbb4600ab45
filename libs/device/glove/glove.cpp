#include "handway/device/glove/glove.h"

#include <stdexcept>

namespace handway::device {

void Glove::check_info(const GloveInfo& info) {
  (void)cyberglove_wired(info.sensors);  // Refuses other numbers of sensors.
  sensors_ = info.sensors;
}

void Glove::check_sample(const GloveFrame& frame) const {
  for (const int sensor : cyberglove_wired(sensors_)) {
    const std::uint16_t count = frame.counts[static_cast<std::size_t>(sensor)];
    if (count < 1 || count > 255) {
      throw std::logic_error("a glove's counts have to be from 1 to 255");
    }
  }
}

}  // namespace handway::device
