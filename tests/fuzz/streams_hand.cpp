/// Lines of the hand protocol: what a hand sends, and what an emulated one is sent.
#include "handway/device/emulators/hand_emulator.h"
#include "handway/device/hand/hand_protocol.h"
#include "handway/device/hand/network_hand.h"
#include "pieces.h"

#include <string>

namespace {

using namespace handway;

void read_state(const std::string& line) {
  try {
    const device::HandState state = device::parse_hand_state(line, 13);
    fuzz::require(state.position.size() == 13 && state.position.allFinite());
  } catch (const device::LineProtocolError& error) {
    fuzz::require(std::string(error.what()).size() < 400);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  device::LineBuffer lines;
  device::HandControllerSettings settings;
  settings.joints = device::sah_joints();
  settings.position = settings.joints.upper.cwiseMin(-0.1);
  device::HandController hand(settings);
  double now = 0.0;
  try {
    fuzz::in_pieces(data, size, [&](fuzz::Bytes bytes) {
      lines.add(bytes);
      while (const auto line = lines.next()) {
        read_state(*line);
        static_cast<void>(hand.receive(*line, now));
        hand.advance(now += 0.01);
        static_cast<void>(hand.feedback());
        fuzz::require(hand.position().allFinite());
      }
    });
  } catch (const device::LineProtocolError&) {
    return 0;
  }
  return 0;
}
