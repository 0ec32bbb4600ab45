/// Messages of hands: datagrams of any kind, and lines.
#include "handway/device/core/line_protocol.h"
#include "handway/device/glove/hand_message.h"
#include "handway/device/glove/human_hand.h"
#include "pieces.h"

#include <cmath>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  try {
    const device::HandMessage message =
        device::read_hand_message({reinterpret_cast<const char*>(data), size});
    fuzz::require(!message.hands.empty());
    for (const device::HandObservation& hand : message.hands) {
      fuzz::require(!hand.time || std::isfinite(*hand.time));
      fuzz::require(!hand.X_SH || hand.X_SH->matrix().allFinite());
      if (hand.landmarks) {
        const device::GloveAngles angles =
            device::glove_angles(device::in_palm_frame(*hand.landmarks, hand.left));
        for (const int sensor : device::landmark_sensors()) {
          fuzz::require(std::isfinite(angles.angles.at(static_cast<std::size_t>(sensor))));
        }
      } else if (hand.angles) {
        for (const int sensor : device::landmark_sensors()) {
          fuzz::require(std::isfinite(hand.angles->at(static_cast<std::size_t>(sensor))));
        }
      }
    }
  } catch (const device::LineProtocolError&) {
  }
  return 0;
}
