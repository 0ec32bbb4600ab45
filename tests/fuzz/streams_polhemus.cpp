/// Output of trackers, and input of emulated ones: the second byte chooses model and format.
#include "handway/device/emulators/tracker_signals.h"
#include "handway/device/emulators/tracker_units.h"
#include "handway/device/tracker/polhemus_parser.h"
#include "pieces.h"

#include <memory>
#include <vector>

namespace {

using namespace handway;

/// @returns how many records there were.
template <typename Parser>
void read(Parser parser, const std::uint8_t* data, std::size_t size) {
  std::uint64_t bytes_taken = 0;
  fuzz::in_pieces(data, size, [&](fuzz::Bytes bytes) {
    bytes_taken += bytes.size();
    for (const device::PolhemusRecord& record : parser.push(bytes)) {
      fuzz::require(record.X_ST.matrix().allFinite() && record.body.size() <= 256);
    }
  });
  fuzz::require(parser.dropped_bytes() <= bytes_taken);
}

void be_sent(std::unique_ptr<device::DeviceUnit> unit, const std::uint8_t* data, std::size_t size) {
  double now = 0.0;
  fuzz::in_pieces(data, size, [&](fuzz::Bytes bytes) {
    static_cast<void>(unit->receive(bytes, now));
    static_cast<void>(unit->advance(now += 0.01));
  });
}

device::FastrakFormat fastrak(std::vector<int> items, bool binary) {
  device::FastrakFormat format;
  format.items = std::move(items);
  format.binary = binary;
  return format;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) {
    return 0;
  }
  const std::uint8_t model = data[0];
  ++data;
  --size;
  switch (model % 6) {
    case 0:
      read(device::FastrakParser(fastrak({2, 11, 16, 0}, true)), data, size);
      break;
    case 1:
      read(device::FastrakParser(fastrak({2, 4, 1}, false)), data, size);
      break;
    case 2:
      read(device::LibertyParser({}), data, size);
      break;
    case 3: {
      device::LibertyFormat format;
      format.items = {10, 8, 2, 4, 1};
      read(device::LibertyParser(format), data, size);
      break;
    }
    case 4:
      be_sent(device::make_fastrak_unit({}, device::wrist_motion_signal(1)), data, size);
      break;
    default:
      be_sent(device::make_liberty_unit({}, device::wrist_motion_signal(1)), data, size);
  }
  return 0;
}
