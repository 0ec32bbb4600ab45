/// Lines of the haptic protocol: what a device sends, and what an emulated one is sent.
#include "handway/device/emulators/haptic_emulator.h"
#include "handway/device/haptic/haptic_protocol.h"
#include "pieces.h"

#include <string>

namespace {

using namespace handway;

template <typename Parse>
void read(const Parse& parse) {
  try {
    parse();
  } catch (const device::LineProtocolError& error) {
    fuzz::require(std::string(error.what()).size() < 400);
  }
}

void read_as_host(const std::string& line) {
  read([&] {
    const device::HapticAbilities abilities = device::parse_haptic_hello(line);
    fuzz::require(abilities.force > 0.0 && abilities.workspace.allFinite());
  });
  read([&] {
    const device::HapticSample sample = device::parse_haptic_state(line);
    fuzz::require(sample.position.allFinite() && sample.velocity.allFinite());
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  device::LineBuffer lines;
  device::EmulatedHaptic haptic({});
  double now = 0.0;
  try {
    fuzz::in_pieces(data, size, [&](fuzz::Bytes bytes) {
      lines.add(bytes);
      while (const auto line = lines.next()) {
        read_as_host(*line);
        static_cast<void>(haptic.receive(*line, now));
        haptic.advance(now += 0.002);
        fuzz::require(haptic.force().allFinite() && haptic.sample().position.allFinite());
      }
    });
  } catch (const device::LineProtocolError&) {
    return 0;
  }
  return 0;
}
