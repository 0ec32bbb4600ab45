#pragma once

#include <algorithm>
#include <array>

namespace handway::device {

/// What to multiply an angle of VirtualHand with to have flexion positive and abduction positive
/// when the fingers spread. VirtualHand turns all abductions about the same direction: index and
/// middle finger spread in its negative, ring and little finger in its positive direction.
[[nodiscard]] inline double virtual_hand_sign(int sensor) {
  constexpr std::array kKept{14, 18};  // RingMiddleAbduct, PinkieRingAbduct
  return std::ranges::find(kKept, sensor) == kKept.end() ? -1.0 : 1.0;
}

}  // namespace handway::device
