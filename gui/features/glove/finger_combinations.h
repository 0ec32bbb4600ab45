#pragma once

#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/human_hand.h"

#include <QString>

#include <array>

namespace handway::gui {

/// Combinations of straight, half bent and bent fingers that have been covered, for each pair of
/// fingers.
class FingerCombinations {
 public:
  static constexpr int kStates = 3;  ///< Straight, half bent, bent.

  void restart() { *this = {}; }
  /// @param ranges of the person.
  void add(const device::GloveAngles& angles, const device::PersonRanges& ranges);

  /// @param a a finger before `b`.
  [[nodiscard]] bool visited(device::Finger a, int state_of_a, device::Finger b,
                             int state_of_b) const;
  /// Returns the covered share of all combinations of measured fingers, in [0, 1]; 0 before the
  /// first posture.
  [[nodiscard]] double share() const;
  /// "Index bent, ring straight": one of two fingers bent and the other straight that is missing;
  /// empty if none is, or nothing was measured.
  [[nodiscard]] QString missing() const;

 private:
  using Cells = std::array<bool, kStates * kStates>;

  std::array<bool, device::kFingers> measured_{};
  std::array<std::array<Cells, device::kFingers>, device::kFingers> cells_{};  ///< [a][b], a < b.
};

}  // namespace handway::gui
