#include "handway/device/tracker/fastrak_parser.h"

#include "polhemus_items.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <stdexcept>
#include <string>
#include <string_view>

namespace handway::device {

namespace {

constexpr std::size_t kHeader = 3;
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

std::size_t item_length(int item, bool binary) {
  switch (item) {
    case 0:
      return 1;
    case 1:
    case 16:
      return 2;
    case 2:
    case 4:
    case 11:
      return number_count(item) * (binary ? 4 : kFieldWidth);
    default:
      throw std::invalid_argument("a Fastrak's record with item " + std::to_string(item));
  }
}

// A number right in its field: blanks, sign, digits, point, digits.
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

// The numbers of one item. @returns nothing if there is something else.
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
  record.body.assign(text.begin() + kHeader, text.end());
  return {kStatusLength, std::move(record)};
}

// Puts one item into `record` or `pose`. @returns whether it can be one.
bool read_item(int item, Bytes bytes, const FastrakFormat& format, PolhemusRecord& record,
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

}  // namespace

std::size_t FastrakFormat::record_length() const {
  std::size_t length = kHeader;
  for (const int item : items) {
    length += item_length(item, binary);
  }
  return length;
}

FastrakParser::FastrakParser(FastrakFormat format) : format_(std::move(format)) {
  (void)format_.record_length();  // Refuses unknown items.
  const auto has = [&](int item) { return std::ranges::count(format_.items, item) > 0; };
  if (!has(2) || !(has(4) || has(11))) {
    throw std::invalid_argument("a Fastrak's records need position and orientation");
  }
}

std::vector<PolhemusRecord> FastrakParser::push(Bytes bytes) {
  return scanner_.scan(bytes, [this](Bytes at) { return classify(at); });
}

ScanVerdict<PolhemusRecord> FastrakParser::classify(Bytes bytes) const {
  if (bytes[0] == '2') {
    return read_status(bytes);
  }
  if (bytes[0] != '0' || (bytes.size() > 1 && (bytes[1] < '1' || bytes[1] > '4')) ||
      (bytes.size() > 2 && !is_error_letter(bytes[2]))) {
    return {};
  }
  const std::size_t length = format_.record_length();
  return bytes.size() < length ? ScanVerdict<PolhemusRecord>{0, {}}
                               : read_data(bytes.first(length));
}

ScanVerdict<PolhemusRecord> FastrakParser::read_data(Bytes bytes) const {
  PolhemusRecord record;
  record.station = bytes[1] - '0';
  record.error = static_cast<char>(bytes[2]);
  PoseItems items;
  LittleEndianReader reader(bytes.subspan(kHeader));
  for (const int item : format_.items) {
    if (!read_item(item, reader.take(item_length(item, format_.binary)), format_, record, items)) {
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
