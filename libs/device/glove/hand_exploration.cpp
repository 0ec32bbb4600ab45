#include "handway/device/glove/hand_exploration.h"

#include "core/random_moves.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/math/units.h"

#include <algorithm>
#include <array>

/// Joint motion of a glove's sensors as a hand moves. All in degrees, sensors in the order of
/// cyberglove_sensors(); the distal joints follow the medial ones.

namespace handway::device {
namespace {

using SensorDegrees = std::array<double, kGloveSensors>;

inline constexpr int kSynergies = 4;

inline constexpr int kMovedFingers = 4;

/// Independent motions of joints: largest deviation, where fingers move by kFingerMove.
inline constexpr int kSmallMoves = 9;
struct SmallMove {
  int sensor;
  double degrees;
};

/// Anatomic limits (KINE-ADL BE-UJI data, and textbook limits rounded).
struct SensorRange {
  double low;
  double high;
};

// Four lines: thumb; index and middle; ring with the abduction of the index before it; little with
// that of the ring before it, its own abduction, palm arch, wrist.
// clang-format off
// The middle of a free hand's postures.
const SensorDegrees kMiddlePosture{
    40.0, 22.0, 26.0, 18.0,
    35.0, 38.0, 0.0, 35.0, 38.0, 0.0,
    2.0, 35.0, 38.0, 0.0,
    2.0, 33.0, 36.0, 0.0, 4.0, 10.0, -5.0, 5.0};

// Change of the middle posture by each synergy at 1: flat fist (at -1: hook), closed (open), thumb
// in opposition (beside the palm), fingers spread (together).
const std::array<SensorDegrees, kSynergies> kHandSynergies{{
    // Flat fist: proximal joints bent, the others straight; the fingers close up.
    {0.0, -7.0, -9.0, 0.0,
     22.0, -11.0, 0.0, 24.0, -11.5, 0.0,
     -3.0, 23.0, -10.0, 0.0,
     -3.0, 21.0, -10.0, 0.0, -3.0, 2.0, 3.0, 0.0},
    // Closed: everything bent together.
    {0.0, 6.0, 9.0, -3.0,
     11.0, 22.0, 0.0, 13.0, 22.0, 0.0,
     -2.0, 13.0, 21.0, 0.0,
     -1.5, 12.0, 20.0, 0.0, -2.0, 4.0, -4.0, 0.0},
    // Opposition.
    {18.0, 5.0, 0.0, 8.0,
     0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
     0.0, 0.0, 0.0, 0.0,
     0.0, 0.0, 0.0, 0.0, 0.0, 5.0, 0.0, 0.0},
    // Spread.
    {0.0, 0.0, 0.0, 4.0,
     0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
     3.0, 0.0, 0.0, 0.0,
     3.0, 0.0, 0.0, 0.0, 5.0, -2.0, 0.0, 0.0},
}};

// Share of one finger's own motion that other fingers follow (row: finger that is meant to move;
// column: fingers that move; index, middle, ring, little). Medians over 23 people of the NinaPro
// DB1 recordings (Atzori et al. 2014).
const std::array<std::array<double, kMovedFingers>, kMovedFingers> kEnslaving{{
    {1.00, 0.20, 0.11, 0.05},
    {0.13, 1.00, 0.35, 0.06},
    {0.05, 0.10, 1.00, 0.14},
    {0.05, 0.05, 0.38, 1.00}}};

const std::array<SmallMove, kSmallMoves> kSmallHandMoves{{
    {0, 3.6}, {1, 6.0}, {2, 14.0}, {3, 4.0}, {10, 2.5}, {14, 2.5}, {19, 5.0}, {20, 12.0}, {21, 6.0}}};

// Motion of proximal and medial joint when a single finger moves at 1.
const std::array<double, 2> kFingerMove{13.5, 15.5};

const std::array<SensorRange, kGloveSensors> kAnatomicRanges{{
    {-15.0, 70.0}, {-20.0, 60.0}, {-10.0, 80.0}, {0.0, 50.0},
    {-20.0, 90.0}, {0.0, 110.0}, {0.0, 80.0}, {-20.0, 90.0}, {0.0, 110.0}, {0.0, 80.0},
    {-15.0, 20.0}, {-20.0, 90.0}, {0.0, 110.0}, {0.0, 80.0},
    {-15.0, 20.0}, {-25.0, 90.0}, {0.0, 100.0}, {0.0, 80.0},
    {-15.0, 29.0}, {0.0, 35.0}, {-70.0, 80.0}, {-20.0, 30.0}}};
// clang-format on

// Index, middle, ring, little: proximal joint; the medial and distal ones follow it.
constexpr std::array<int, kMovedFingers> kProximal{4, 7, 11, 15};
// Abductions, and the finger beside the middle one whose flexion hinders them.
constexpr std::array<std::pair<int, int>, 3> kAbductions{{{10, 4}, {14, 11}, {18, 15}}};

constexpr double kDistalShare = 2.0 / 3.0;
// Offsets of seeds, so that every kind of move has its own numbers.
constexpr std::uint64_t kStreams = 1000;
// Flexion from which fingers can't spread any more, degrees.
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
  for (std::size_t meant = 0; meant < kMovedFingers; ++meant) {
    for (std::size_t moved = 0; moved < kMovedFingers; ++moved) {
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
        fingers(2 * kMovedFingers, kSingleFinger, kStreams * seed + 1),
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
