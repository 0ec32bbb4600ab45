#pragma once

#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/hand_message.h"
#include "handway/device/glove/human_hand.h"

#include <array>
#include <optional>
#include <string>

/// Messages of hands as senders of each format write them.

namespace handway::device {

/// A hand to send. Without landmarks and angles it is not seen.
struct EmulatedHand {
  double time = 0.0;  ///< s, on the sender's clock.
  bool left = false;
  std::optional<HandLandmarks> landmarks;                   ///< m, in a right-handed frame.
  std::optional<std::array<double, kGloveSensors>> angles;  ///< rad, by sensor.
};

/// Returns a message with its end of line, of a datagram of LZ4 without one.
/// @pre landmarks and angles are both there or neither is.
[[nodiscard]] std::string encoded_hand(HandWire wire, const EmulatedHand& hand);

}  // namespace handway::device
