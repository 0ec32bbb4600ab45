#include "handway/device/glove/generated_recording.h"

#include "handway/device/glove/glove_signals.h"

#include <fmt/format.h>

#include <numeric>
#include <stdexcept>

namespace handway::device {

Recording generate_recording(std::uint64_t seed, int rows, double rate) {
  if (rows < 1 || !(rate > 0.0)) {
    throw std::invalid_argument("a recording needs rows and a rate");
  }
  Recording recording;
  recording.header.kind = RecordingKind::kCounts;
  recording.header.device = "emulated CyberGlove, 22 sensors, typical calibration";
  recording.header.origin = fmt::format(
      "handway glove generate --seed {} --samples {} --rate {}: a synthetic hand that explores its "
      "workspace",
      seed, rows, rate);
  recording.header.sensors.resize(kGloveSensors);
  std::iota(recording.header.sensors.begin(), recording.header.sensors.end(), 0);
  recording.times.resize(rows);
  recording.values.resize(rows, kGloveSensors);
  const GloveSignal signal = exploring_hand_signal(seed);
  for (Eigen::Index row = 0; row < rows; ++row) {
    recording.times[row] = static_cast<double>(row) / rate;
    const auto counts = signal(recording.times[row]);
    for (std::size_t sensor = 0; sensor < counts.size(); ++sensor) {
      recording.values(row, static_cast<Eigen::Index>(sensor)) = counts.at(sensor);
    }
  }
  return recording;
}

}  // namespace handway::device
