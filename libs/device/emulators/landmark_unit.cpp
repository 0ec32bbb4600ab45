#include "handway/device/emulators/landmark_unit.h"

#include "core/random_moves.h"
#include "emulators/hand_wires.h"
#include "glove/recording_player.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/human_hand.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/pose.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace handway::device {

HandSignal recorded_hand(const Recording& recording) {
  if (recording.header.kind != RecordingKind::kAngles) {
    throw geometric::InputError(
        {"recording", "", "raw counts", "angles", "Give a calibration of the glove"});
  }
  const auto player = std::make_shared<const RecordingPlayer>(recording, typical_calibration());
  return [player](double time) {
    return GloveAngles{time, *player->frame_at(std::fmod(time, player->duration())).angles};
  };
}

namespace {

constexpr double kLandmarkBacklog = 0.25;  // s

/// Pose of the hand before the camera: half a metre away, turning to and fro.
geometric::Pose hand_pose(double time) {
  const geometric::Pose X_CH = geometric::pose_from_rpy(
      Eigen::Vector3d(0.05 * std::sin(0.7 * time), 0.03 * std::sin(0.9 * time), 0.5),
      0.5 * std::sin(0.5 * time), 0.4 * std::sin(0.8 * time), 0.6 * std::sin(0.3 * time));
  return X_CH;
}

class LandmarkUnit final : public DeviceUnit {
 public:
  LandmarkUnit(const LandmarkUnitSettings& settings, HandSignal signal)
      : settings_(settings), signal_(std::move(signal)), random_(settings.seed) {
    if (!(settings.rate > 0.0)) {
      throw std::invalid_argument("landmarks have to be sent at a rate above 0");
    }
  }

  Bytes receive(std::span<const std::uint8_t> /*bytes*/, double /*now*/) override { return {}; }

  std::vector<Bytes> advance(double now) override {
    next_ = std::max(next_, now - kLandmarkBacklog);
    std::vector<Bytes> lines;
    for (; next_ <= now; next_ += 1.0 / settings_.rate) {
      const std::string message = encoded_hand(settings_.wire, seen_at(next_));
      lines.emplace_back(message.begin(), message.end());
    }
    return lines;
  }

  [[nodiscard]] std::optional<double> next_due() const override { return next_; }
  void set_plugged(bool plugged) override { plugged_ = plugged; }

 private:
  EmulatedHand seen_at(double time) {
    EmulatedHand hand{time, settings_.left != settings_.wrong_label, {}, {}};
    const GloveAngles angles = signal_(time);
    if (!plugged_) {
      return hand;
    }
    hand.angles = angles.angles;
    HandLandmarks landmarks = hand_landmarks(angles);
    if (settings_.left) {
      landmarks.row(2) *= -1.0;
    }
    landmarks = hand_pose(time) * landmarks;
    for (double& coordinate : landmarks.reshaped()) {
      coordinate += settings_.noise > 0.0 ? settings_.noise * random_.normal() : 0.0;
    }
    hand.landmarks = landmarks;
    return hand;
  }

  LandmarkUnitSettings settings_;
  HandSignal signal_;
  SeededRandom random_;
  double next_ = 0.0;
  bool plugged_ = true;
};

}  // namespace

std::unique_ptr<DeviceUnit> make_landmark_unit(const LandmarkUnitSettings& settings,
                                               HandSignal signal) {
  return std::make_unique<LandmarkUnit>(settings, std::move(signal));
}

}  // namespace handway::device
