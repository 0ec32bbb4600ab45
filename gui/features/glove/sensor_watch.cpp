#include "features/glove/sensor_watch.h"

#include <algorithm>

namespace handway::gui {
namespace {

constexpr int kStill = 3;                // counts, as in RecordingQuality
constexpr int kMoved = 12;               // counts
constexpr int kEnoughMoving = 4;         // sensors
constexpr double kPatience = 5.0;        // s
constexpr double kRecent = 0.02;         // weight of the latest frame
constexpr double kMostlyAtEnd = 0.5;     // share
constexpr std::uint16_t kLargest = 255;  // counts

}  // namespace

void SensorWatch::take(const device::GloveFrame& frame) {
  const bool first = first_time_ < 0.0;
  if (first) {
    first_time_ = frame.time;
  }
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    Sensor& sensor = sensors_.at(i);
    const std::uint16_t counts = frame.counts.at(i);
    sensor.least = first ? counts : std::min(sensor.least, counts);
    sensor.most = first ? counts : std::max(sensor.most, counts);
    sensor.counts = counts;
    const bool at_end = counts == 1 || counts >= kLargest;
    sensor.at_end += kRecent * ((at_end ? 1.0 : 0.0) - sensor.at_end);
  }
  const bool judge = frame.time - first_time_ > kPatience && moving() >= kEnoughMoving;
  for (Sensor& sensor : sensors_) {
    if (sensor.counts == 0) {
      sensor.verdict = Verdict::kMissing;
    } else if (sensor.at_end > kMostlyAtEnd) {
      sensor.verdict = Verdict::kSaturated;
    } else if (judge && sensor.most - sensor.least < kStill) {
      sensor.verdict = Verdict::kDead;
    } else {
      sensor.verdict = Verdict::kGood;
    }
  }
}

int SensorWatch::moving() const {
  return static_cast<int>(std::ranges::count_if(
      sensors_, [](const Sensor& sensor) { return sensor.most - sensor.least > kMoved; }));
}

}  // namespace handway::gui
