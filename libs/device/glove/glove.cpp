#include "handway/device/glove/glove.h"

#include "handway/device/glove/glove_layout.h"

#include <stdexcept>

namespace handway::device {

GloveInfo Glove::connect(const std::stop_token& stop) {
  disconnect();
  clock_.start();
  GloveInfo info = do_connect(stop);
  (void)cyberglove_wired(info.sensors);  // Refuses other numbers of sensors.
  sensors_ = info.sensors;
  connected_ = true;
  return info;
}

GloveReading Glove::next(std::chrono::milliseconds timeout, const std::stop_token& stop) {
  if (!connected_) {
    throw std::logic_error("a glove has to be connected before it is read");
  }
  GloveReading reading = do_next(timeout, stop);
  if (reading.event != GloveEvent::kFrame) {
    return reading;
  }
  for (const int sensor : cyberglove_wired(sensors_)) {
    const std::uint16_t count = reading.frame.counts[static_cast<std::size_t>(sensor)];
    if (count < 1 || count > 255) {
      throw std::logic_error("a glove's counts have to be from 1 to 255");
    }
  }
  reading.frame.time = clock_.not_before_last(reading.frame.time);
  return reading;
}

void Glove::disconnect() noexcept {
  if (connected_) {
    connected_ = false;
    do_disconnect();
  }
}

}  // namespace handway::device
