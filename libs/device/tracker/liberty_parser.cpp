#include "handway/device/tracker/liberty_parser.h"

#include "polhemus_items.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace handway::device {

namespace {

constexpr std::size_t kHeader = 8;
// Longer replies than any that a driver asks for, so that a damaged length doesn't hold up poses.
constexpr std::size_t kLongestReply = 256;
constexpr int kStations = 16;

using Bytes = std::span<const std::uint8_t>;

std::size_t item_length(int item) {
  switch (item) {
    case 0:
      return 1;
    case 1:
      return 2;
    case 2:
    case 3:
    case 4:
      return 12;
    case 7:
      return 16;
    case 8:
    case 9:
    case 10:
    case 11:
      return 4;
    default:
      throw std::invalid_argument("a Liberty's record with item " + std::to_string(item));
  }
}

bool is_preamble(std::uint8_t first, std::uint8_t second) {
  constexpr std::array<std::array<char, 2>, 3> kPreambles{{{'L', 'Y'}, {'P', 'A'}, {'L', 'U'}}};
  return std::ranges::any_of(kPreambles, [&](const auto& preamble) {
    return first == preamble[0] && second == preamble[1];
  });
}

bool is_data(Bytes header) { return header[3] == 'C' || header[3] == 'P'; }

bool read_item(int item, Bytes bytes, bool centimetres, PolhemusRecord& record, PoseItems& pose) {
  LittleEndianReader reader(bytes);
  switch (item) {
    case 0:
      return bytes[0] == ' ';
    case 1:
      return bytes[0] == '\r' && bytes[1] == '\n';
    case 2:
    case 3:
      pose.set_position(reader.take_vector() *
                        (centimetres ? kMetresPerCentimetre : kMetresPerInch));
      return true;
    case 4:
      pose.set_angles(reader.take_vector());
      return true;
    case 7:
      pose.set_quaternion(reader.take_four());
      return true;
    case 8:
      record.unit_time = reader.take_u32() / 1000.0;
      return true;
    case 10: {
      const std::uint32_t value = reader.take_u32();
      record.button = value == 1;
      return value <= 1;
    }
    default:
      return true;
  }
}

}  // namespace

std::size_t LibertyFormat::body_length() const {
  std::size_t length = 0;
  for (const int item : items) {
    length += item_length(item);
  }
  return length;
}

LibertyParser::LibertyParser(LibertyFormat format) : format_(std::move(format)) {
  (void)format_.body_length();  // Refuses unknown items.
  const auto has = [&](int item) { return std::ranges::count(format_.items, item) > 0; };
  if (!(has(2) || has(3)) || !(has(4) || has(7))) {
    throw std::invalid_argument("a Liberty's records need position and orientation");
  }
}

std::vector<PolhemusRecord> LibertyParser::push(Bytes bytes) {
  return scanner_.scan(bytes, [this](Bytes at) { return classify(at); });
}

ScanVerdict<PolhemusRecord> LibertyParser::classify(Bytes bytes) const {
  if ((bytes[0] != 'L' && bytes[0] != 'P') ||
      (bytes.size() > 1 && !is_preamble(bytes[0], bytes[1])) ||
      (bytes.size() > 4 && (bytes[4] < 0x20 || bytes[4] > 0x7E))) {
    return {};
  }
  if (bytes.size() < kHeader) {
    return {0, {}};
  }
  const std::size_t body = static_cast<std::size_t>(bytes[6]) | std::size_t{bytes[7]} << 8U;
  if (is_data(bytes) ? body != format_.body_length() || bytes[2] < 1 || bytes[2] > kStations
                     : body > kLongestReply) {
    return {};
  }
  if (bytes.size() < kHeader + body) {
    return {0, {}};
  }
  if (is_data(bytes)) {
    return read_data(bytes.first(kHeader + body));
  }
  PolhemusRecord record;
  record.kind = PolhemusRecordKind::kReply;
  record.station = bytes[2];
  record.command = static_cast<char>(bytes[3]);
  record.error = static_cast<char>(bytes[4]);
  const Bytes text = bytes.subspan(kHeader, body);
  record.body.assign(text.begin(), text.end());
  return {kHeader + body, std::move(record)};
}

ScanVerdict<PolhemusRecord> LibertyParser::read_data(Bytes bytes) const {
  PolhemusRecord record;
  record.station = bytes[2];
  record.error = static_cast<char>(bytes[4]);
  PoseItems items;
  LittleEndianReader reader(bytes.subspan(kHeader));
  for (const int item : format_.items) {
    if (!read_item(item, reader.take(item_length(item)), format_.centimetres, record, items)) {
      return {};
    }
  }
  const auto X_ST = items.pose();
  if (!X_ST) {
    return {};
  }
  record.X_ST = *X_ST;
  record.kind = record.error == ' ' ? PolhemusRecordKind::kPose : PolhemusRecordKind::kDoubtful;
  return {bytes.size(), std::move(record)};
}

}  // namespace handway::device
