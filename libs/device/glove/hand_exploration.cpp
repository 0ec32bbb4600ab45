#include "handway/device/glove/hand_exploration.h"

#include "core/minimum_jerk_moves.h"
#include "hand_synergies.h"
#include "handway/geometric/math/units.h"

#include <algorithm>

namespace handway::device {

namespace {

// Index, middle, ring, little: proximal joint; the medial and distal ones follow it.
constexpr std::array<int, kFingers> kProximal{4, 7, 11, 15};
// Abductions, and the finger beside the middle one whose flexion hinders them.
constexpr std::array<std::pair<int, int>, 3> kAbductions{{{10, 4}, {14, 11}, {18, 15}}};

constexpr double kDistalShare = 2.0 / 3.0;
// Seeds far enough apart for every kind of move to have its own numbers.
constexpr std::uint64_t kStreams = 1000;
// Fingers bent so far can't spread any more, degrees.
constexpr double kLockedFlexion = 90.0;

constexpr MovePace kWholeHand{};
constexpr MovePace kSingleFinger{.reaction = 0.3, .per_unit = 0.25, .longest_rest = 0.4};
constexpr MovePace kSmall{.reaction = 0.5, .per_unit = 0.4, .longest_rest = 0.5};

double& at(SensorDegrees& degrees, int sensor) { return degrees[static_cast<std::size_t>(sensor)]; }

void add_synergies(const Eigen::VectorXd& amounts, SensorDegrees& posture) {
  for (std::size_t k = 0; k < kSynergies; ++k) {
    for (std::size_t sensor = 0; sensor < posture.size(); ++sensor) {
      posture[sensor] += amounts[static_cast<Eigen::Index>(k)] * kHandSynergies[k][sensor];
    }
  }
}

// @param amounts proximal and medial joint of index, middle, ring and little finger.
void add_finger_moves(const Eigen::VectorXd& amounts, SensorDegrees& posture) {
  for (std::size_t meant = 0; meant < kFingers; ++meant) {
    for (std::size_t moved = 0; moved < kFingers; ++moved) {
      for (int joint = 0; joint < 2; ++joint) {
        at(posture, kProximal[moved] + joint) +=
            amounts[static_cast<Eigen::Index>(meant) * 2 + joint] * kEnslaving[meant][moved] *
            kFingerMove[static_cast<std::size_t>(joint)];
      }
    }
  }
}

void add_small_moves(const Eigen::VectorXd& amounts, SensorDegrees& posture) {
  for (std::size_t k = 0; k < kSmallMoves; ++k) {
    at(posture, kSmallHandMoves[k].sensor) +=
        amounts[static_cast<Eigen::Index>(k)] * kSmallHandMoves[k].degrees;
  }
}

void keep_to_anatomy(SensorDegrees& posture) {
  for (const auto& [abduction, flexion] : kAbductions) {
    const double bent = std::max(at(posture, flexion), 0.0) / kLockedFlexion;
    at(posture, abduction) *= std::max(1.0 - bent, 0.0);
  }
  for (const int proximal : kProximal) {
    at(posture, proximal + 2) = kDistalShare * at(posture, proximal + 1);
  }
  for (std::size_t sensor = 0; sensor < posture.size(); ++sensor) {
    posture[sensor] =
        std::clamp(posture[sensor], kAnatomicRanges[sensor].low, kAnatomicRanges[sensor].high);
  }
}

}  // namespace

struct HandExploration::Moves {
  explicit Moves(std::uint64_t seed)
      : synergies(kSynergies, kWholeHand, kStreams * seed),
        fingers(2 * kFingers, kSingleFinger, kStreams * seed + 1),
        small(kSmallMoves, kSmall, kStreams * seed + 2) {}

  MinimumJerkMoves synergies;
  MinimumJerkMoves fingers;
  MinimumJerkMoves small;
};

HandExploration::HandExploration(std::uint64_t seed) : moves_(std::make_unique<Moves>(seed)) {}
HandExploration::~HandExploration() = default;
HandExploration::HandExploration(HandExploration&&) noexcept = default;
HandExploration& HandExploration::operator=(HandExploration&&) noexcept = default;

GloveAngles HandExploration::at(double time) {
  SensorDegrees posture = kMiddlePosture;
  add_synergies(moves_->synergies.at(time), posture);
  add_finger_moves(moves_->fingers.at(time), posture);
  add_small_moves(moves_->small.at(time), posture);
  keep_to_anatomy(posture);
  GloveAngles angles;
  angles.time = time;
  std::ranges::transform(posture, angles.angles.begin(), geometric::radians);
  return angles;
}

}  // namespace handway::device
