/// Output of a CyberGlove, as records and as answers, and input of an emulated one.
#include "cyberglove_protocol.h"
#include "handway/device/emulators/glove_emulator.h"
#include "handway/device/glove/cyberglove3_parser.h"
#include "handway/device/glove/cyberglove_parser.h"
#include "pieces.h"

#include <algorithm>
#include <vector>

namespace {

using namespace handway;

void read_records(auto parser, const std::uint8_t* data, std::size_t size) {
  fuzz::in_pieces(data, size, [&](fuzz::Bytes bytes) {
    for (const std::uint8_t byte : bytes) {
      const auto record = parser.push(byte);
      if (record && record->kind == device::CyberGloveRecordKind::kSample) {
        for (const std::uint16_t count : record->counts) {
          fuzz::require(count <= 255);
        }
      }
    }
  });
  fuzz::require(parser.dropped_bytes() <= size);
}

/// All bytes have come.
struct AtEnd {};

/// A line on which these bytes come, in pieces, whatever is asked.
class Line final : public device::ByteLink {
 public:
  Line(const std::uint8_t* data, std::size_t size) : ByteLink("line") {
    fuzz::in_pieces(data, size, [this](fuzz::Bytes bytes) { pieces_.push_back(bytes); });
  }

 private:
  std::size_t do_read(std::span<std::uint8_t> bytes,
                      std::chrono::milliseconds /*timeout*/) override {
    if (next_ == pieces_.size()) {
      throw AtEnd{};
    }
    const fuzz::Bytes piece = pieces_[next_++];
    const std::size_t count = std::min(piece.size(), bytes.size());
    std::copy_n(piece.begin(), count, bytes.begin());
    return count;
  }
  void do_write(std::span<const std::uint8_t> /*bytes*/,
                std::chrono::milliseconds /*timeout*/) override {}

  std::vector<fuzz::Bytes> pieces_;
  std::size_t next_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  device::CyberGloveFormat whole;
  whole.time_stamp = true;
  whole.status = true;
  read_records(device::CyberGloveParser({}), data, size);
  read_records(device::CyberGloveParser({.sensors = 18}), data, size);
  read_records(device::CyberGloveParser(whole), data, size);
  read_records(device::CyberGlove3Parser(), data, size);
  Line line(data, size);
  device::CyberGloveCommands commands(line, std::chrono::milliseconds(1000));
  try {
    while (const auto reply = commands.query('V', 4, {})) {
      fuzz::require(reply->data.size() <= 4);
    }
  } catch (const AtEnd&) {
    // The input ends here.
  }
  const auto signal = [](double) {
    std::array<std::uint16_t, device::kGloveSensors> counts{};
    counts.fill(100);
    return counts;
  };
  device::CyberGloveUnit unit({}, signal);
  device::CyberGlove3Unit third(signal);
  double now = 0.0;
  fuzz::in_pieces(data, size, [&](fuzz::Bytes bytes) {
    static_cast<void>(unit.receive(bytes, now));
    static_cast<void>(third.receive(bytes, now));
    now += 0.01;
    static_cast<void>(unit.advance(now));
    static_cast<void>(third.advance(now));
  });
  return 0;
}
