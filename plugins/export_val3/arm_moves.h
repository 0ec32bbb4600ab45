#pragma once

#include "handway/planning/core/exporter.h"

#include <array>
#include <vector>

namespace handway::export_val3 {

/// A joint move of the arm to a point, from rest to rest.
struct ArmMove {
  std::array<double, 6> point{};  ///< deg
  double velocity = 100.0;        ///< % of the nominal joint speed, above 0.
  double acceleration = 100.0;    ///< % of the nominal joint acceleration, above 0.
  double pause = 0.0;             ///< s: above 0 the arm stays where it is, while the hand moves.
};

/// A move to each waypoint, the first one being where the motion begins. Speeds are such that
/// moves take as long as in the motion, the joints speeding up, running and slowing down
/// together at the limits that the motion was timed with.
/// @throws InputError if the arm has not six joints that turn.
[[nodiscard]] std::vector<ArmMove> arm_moves(const planning::Motion& motion);

}  // namespace handway::export_val3
