#pragma once

#include "handway/device/glove/glove_frame.h"

#include <array>

/// How the sensors of a glove move together when a hand does. All in degrees, sensors in the order
/// of cyberglove_sensors(); the distal joints follow the medial ones.
namespace handway::device {

using SensorDegrees = std::array<double, kGloveSensors>;

/// The middle of a free hand's postures.
extern const SensorDegrees kMiddlePosture;

inline constexpr int kSynergies = 4;
/// What each synergy at 1 adds to the middle posture: flat fist (at -1: hook), closed (open),
/// thumb in opposition (beside the palm), fingers spread (together).
extern const std::array<SensorDegrees, kSynergies> kHandSynergies;

inline constexpr int kFingers = 4;
/// How much of one finger's own motion the others make with it (row: finger that is meant to
/// move; column: fingers that move; index, middle, ring, little). Medians over 23 people of the
/// NinaPro DB1 recordings (Atzori et al. 2014).
extern const std::array<std::array<double, kFingers>, kFingers> kEnslaving;

/// What joints do on their own: largest deviation, where fingers move by kFingerMove.
inline constexpr int kSmallMoves = 9;
struct SmallMove {
  int sensor;
  double degrees;
};
extern const std::array<SmallMove, kSmallMoves> kSmallHandMoves;
/// Of proximal and medial joint when a single finger moves at 1.
extern const std::array<double, 2> kFingerMove;

/// Anatomic limits (KINE-ADL BE-UJI data, and textbook limits rounded).
struct SensorRange {
  double low;
  double high;
};
extern const std::array<SensorRange, kGloveSensors> kAnatomicRanges;

}  // namespace handway::device
