#include "handway/device/tracker/polhemus_parser.h"

#include "polhemus_items.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <stdexcept>
#include <string>
#include <string_view>

namespace handway::device {
namespace {

constexpr std::size_t kFastrakHeader = 3;
constexpr std::size_t kStatusLength = 55;
constexpr std::size_t kFieldWidth = 7;

using Bytes = std::span<const std::uint8_t>;

std::size_t number_count(int item) {
  switch (item) {
    case 2:
    case 4:
      return 3;
    case 11:
      return 4;
    default:
      return 0;
  }
}

// Bytes of an item.
std::size_t item_length(const FastrakFormat& format, int item) {
  switch (item) {
    case 0:
      return 1;
    case 1:
    case 16:
      return 2;
    case 2:
    case 4:
    case 11:
      return number_count(item) * (format.binary ? 4 : kFieldWidth);
    default:
      throw std::invalid_argument("a Fastrak's record with item " + std::to_string(item));
  }
}

// A right-aligned number in its field: blanks, sign, digits, point, digits.
std::optional<double> field_value(Bytes field) {
  std::string_view text(reinterpret_cast<const char*>(field.data()), field.size());
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  if (text.starts_with('+')) {
    text.remove_prefix(1);
  }
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, std::chars_format::fixed);
  return error == std::errc() && stop == end && text.find('.') != std::string_view::npos
             ? std::optional(value)
             : std::nullopt;
}

// The numbers of one item. @returns nothing for other characters.
template <int Count>
std::optional<Eigen::Matrix<double, Count, 1>> numbers(Bytes item, bool binary) {
  Eigen::Matrix<double, Count, 1> values;
  LittleEndianReader reader(item);
  for (double& value : values) {
    if (binary) {
      value = reader.take_float();
    } else if (const auto read = field_value(reader.take(kFieldWidth))) {
      value = *read;
    } else {
      return std::nullopt;
    }
  }
  return values;
}

bool is_printable(std::uint8_t byte) { return byte >= 0x20 && byte < 0x7F; }

bool is_error_letter(std::uint8_t byte) { return byte == ' ' || std::isalpha(byte) != 0; }

// '2', station, 'S', text, CR LF.
ScanVerdict<PolhemusRecord> read_status(Bytes bytes) {
  if ((bytes.size() > 1 && std::isdigit(bytes[1]) == 0) || (bytes.size() > 2 && bytes[2] != 'S')) {
    return {};
  }
  const Bytes text = bytes.first(std::min(bytes.size(), kStatusLength - 2));
  if (!std::ranges::all_of(text, is_printable)) {
    return {};
  }
  if (bytes.size() < kStatusLength) {
    return {0, {}};
  }
  if (bytes[kStatusLength - 2] != '\r' || bytes[kStatusLength - 1] != '\n') {
    return {};
  }
  PolhemusRecord record;
  record.kind = PolhemusRecordKind::kReply;
  record.station = bytes[1] - '0';
  record.command = 'S';
  record.body.assign(text.begin() + kFastrakHeader, text.end());
  return {kStatusLength, std::move(record)};
}

// Reads one item into `record` or `pose`. @returns whether it is valid.
bool read_item(const FastrakFormat& format, int item, Bytes bytes, PolhemusRecord& record,
               PoseItems& pose) {
  switch (item) {
    case 0:
      return bytes[0] == ' ';
    case 1:
      return bytes[0] == '\r' && bytes[1] == '\n';
    case 16:
      record.button = bytes[1] == '1';
      return bytes[0] == ' ' && (bytes[1] == '0' || bytes[1] == '1');
    case 2:
      if (const auto position = numbers<3>(bytes, format.binary)) {
        pose.set_position(*position * (format.centimetres ? kMetresPerCentimetre : kMetresPerInch));
        return true;
      }
      return false;
    case 4:
      if (const auto angles = numbers<3>(bytes, format.binary)) {
        pose.set_angles(*angles);
        return true;
      }
      return false;
    default:
      if (const auto quaternion = numbers<4>(bytes, format.binary)) {
        pose.set_quaternion(*quaternion);
        return true;
      }
      return false;
  }
}

constexpr std::size_t kLibertyHeader = 8;
// Longest reply that a driver requests: a damaged length must not delay poses.
constexpr std::size_t kLongestReply = 256;
constexpr int kStations = 16;

std::size_t item_length(const LibertyFormat& /*format*/, int item) {
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

bool read_item(const LibertyFormat& format, int item, Bytes bytes, PolhemusRecord& record,
               PoseItems& pose) {
  LittleEndianReader reader(bytes);
  switch (item) {
    case 0:
      return bytes[0] == ' ';
    case 1:
      return bytes[0] == '\r' && bytes[1] == '\n';
    case 2:
    case 3:
      pose.set_position(reader.take_vector() *
                        (format.centimetres ? kMetresPerCentimetre : kMetresPerInch));
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

// The items behind the header of a data record.
template <typename Format>
ScanVerdict<PolhemusRecord> read_data(const Format& format, Bytes bytes, std::size_t header,
                                      int station, char error) {
  PolhemusRecord record;
  record.station = station;
  record.error = error;
  PoseItems items;
  LittleEndianReader reader(bytes.subspan(header));
  for (const int item : format.items) {
    if (!read_item(format, item, reader.take(item_length(format, item)), record, items)) {
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

bool has(const OutputList& items, int item) { return std::ranges::count(items, item) > 0; }

void check(const FastrakFormat& format) {
  (void)format.record_length();  // Refuses unknown items.
  if (!has(format.items, 2) || !(has(format.items, 4) || has(format.items, 11))) {
    throw std::invalid_argument("a Fastrak's records need position and orientation");
  }
}

ScanVerdict<PolhemusRecord> classify(const FastrakFormat& format, Bytes bytes) {
  if (bytes[0] == '2') {
    return read_status(bytes);
  }
  if (bytes[0] != '0' || (bytes.size() > 1 && (bytes[1] < '1' || bytes[1] > '4')) ||
      (bytes.size() > 2 && !is_error_letter(bytes[2]))) {
    return {};
  }
  const std::size_t length = format.record_length();
  return bytes.size() < length ? ScanVerdict<PolhemusRecord>{0, {}}
                               : read_data(format, bytes.first(length), kFastrakHeader,
                                           bytes[1] - '0', static_cast<char>(bytes[2]));
}

void check(const LibertyFormat& format) {
  (void)format.body_length();  // Refuses unknown items.
  if (!(has(format.items, 2) || has(format.items, 3)) ||
      !(has(format.items, 4) || has(format.items, 7))) {
    throw std::invalid_argument("a Liberty's records need position and orientation");
  }
}

ScanVerdict<PolhemusRecord> classify(const LibertyFormat& format, Bytes bytes) {
  if ((bytes[0] != 'L' && bytes[0] != 'P') ||
      (bytes.size() > 1 && !is_preamble(bytes[0], bytes[1])) ||
      (bytes.size() > 4 && (bytes[4] < 0x20 || bytes[4] > 0x7E))) {
    return {};
  }
  if (bytes.size() < kLibertyHeader) {
    return {0, {}};
  }
  const std::size_t body = static_cast<std::size_t>(bytes[6]) | std::size_t{bytes[7]} << 8U;
  if (is_data(bytes) ? body != format.body_length() || bytes[2] < 1 || bytes[2] > kStations
                     : body > kLongestReply) {
    return {};
  }
  if (bytes.size() < kLibertyHeader + body) {
    return {0, {}};
  }
  if (is_data(bytes)) {
    return read_data(format, bytes.first(kLibertyHeader + body), kLibertyHeader, bytes[2],
                     static_cast<char>(bytes[4]));
  }
  PolhemusRecord record;
  record.kind = PolhemusRecordKind::kReply;
  record.station = bytes[2];
  record.command = static_cast<char>(bytes[3]);
  record.error = static_cast<char>(bytes[4]);
  const Bytes text = bytes.subspan(kLibertyHeader, body);
  record.body.assign(text.begin(), text.end());
  return {kLibertyHeader + body, std::move(record)};
}

}  // namespace

std::size_t FastrakFormat::record_length() const {
  std::size_t length = kFastrakHeader;
  for (const int item : items) {
    length += item_length(*this, item);
  }
  return length;
}

std::size_t LibertyFormat::body_length() const {
  std::size_t length = 0;
  for (const int item : items) {
    length += item_length(*this, item);
  }
  return length;
}

template <typename Format>
PolhemusParser<Format>::PolhemusParser(Format format) : format_(std::move(format)) {
  check(format_);
}

template <typename Format>
std::vector<PolhemusRecord> PolhemusParser<Format>::push(Bytes bytes) {
  return scanner_.scan(bytes, [this](Bytes at) { return classify(format_, at); });
}

template class PolhemusParser<FastrakFormat>;
template class PolhemusParser<LibertyFormat>;

}  // namespace handway::device
