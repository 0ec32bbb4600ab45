#include "handway/device/emulators/glove_signals.h"

#include "core/random_moves.h"
#include "glove/recording_player.h"
#include "handway/device/glove/hand_exploration.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>

namespace handway::device {
namespace {

constexpr std::uint16_t kSaturated = 255;

using Counts = std::array<std::uint16_t, kGloveSensors>;

class Noise {
 public:
  Noise(std::uint64_t seed, SensorFaults faults) : faults_(std::move(faults)), random_(seed) {}

  Counts apply(const std::array<double, kGloveSensors>& exact) {
    Counts counts{};
    for (std::size_t k = 0; k < counts.size(); ++k) {
      const double noise = faults_.noise > 0.0 ? faults_.noise * random_.normal() : 0.0;
      counts[k] =
          faults_.saturated.contains(static_cast<int>(k)) ? kSaturated : to_count(exact[k] + noise);
    }
    return counts;
  }

 private:
  SensorFaults faults_;
  SeededRandom random_;
};

}  // namespace

GloveSignal exploring_hand_signal(std::uint64_t seed, const SensorFaults& faults,
                                  const GloveCalibration& calibration) {
  const auto hand = std::make_shared<HandExploration>(seed);
  return [hand, noise = Noise(seed, faults), calibration](double time) mutable {
    const GloveAngles angles = hand->at(time);
    std::array<double, kGloveSensors> exact{};
    for (std::size_t k = 0; k < exact.size(); ++k) {
      exact[k] = counts_of(calibration.sensors[k], angles.angles[k]);
    }
    return noise.apply(exact);
  };
}

GloveSignal recorded_signal(const Recording& recording, std::uint64_t seed,
                            const SensorFaults& faults, const GloveCalibration& calibration) {
  const auto player = std::make_shared<const RecordingPlayer>(recording, calibration);
  return [player, noise = Noise(seed, faults)](double time) mutable {
    const GloveFrame& frame = player->frame_at(std::fmod(time, player->duration()));
    std::array<double, kGloveSensors> exact{};
    for (std::size_t k = 0; k < exact.size(); ++k) {
      exact[k] = frame.counts[k] == 0 ? kMidScale : frame.counts[k];
    }
    return noise.apply(exact);
  };
}

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
