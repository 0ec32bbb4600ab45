#include "recordings/message_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace handway::device {
namespace {

constexpr std::size_t kEncapsulation = 4;

}  // namespace

MessageReader::MessageReader(std::string_view message, MessageEncoding encoding) {
  if (encoding == MessageEncoding::kRos1) {
    body_ = message;
    is_aligned_ = false;
    has_sequence_ = true;
    return;
  }
  if (message.size() < kEncapsulation || message[0] != 0 || (message[1] != 0 && message[1] != 1)) {
    throw MessageError("an encoding other than CDR");
  }
  big_endian_ = message[1] == 0;
  body_ = message.substr(kEncapsulation);
}

std::string_view MessageReader::take(std::size_t size) {
  if (size > body_.size() - std::min(at_, body_.size())) {
    throw MessageError("an end within a field");
  }
  const std::string_view bytes = body_.substr(at_, size);
  at_ += size;
  return bytes;
}

template <typename Number>
Number MessageReader::number() {
  if (is_aligned_) {
    at_ = (at_ + sizeof(Number) - 1) / sizeof(Number) * sizeof(Number);
  }
  const std::string_view bytes = take(sizeof(Number));
  std::array<char, sizeof(Number)> copy{};
  std::memcpy(copy.data(), bytes.data(), copy.size());
  if (big_endian_) {
    std::ranges::reverse(copy);
  }
  return std::bit_cast<Number>(copy);
}

std::int32_t MessageReader::int32() { return number<std::int32_t>(); }

std::uint32_t MessageReader::uint32() { return number<std::uint32_t>(); }

double MessageReader::float64() { return number<double>(); }

void MessageReader::skip(std::size_t bytes) { static_cast<void>(take(bytes)); }

void MessageReader::skip_sequence(std::size_t size) {
  const std::size_t elements = count(size);
  static_cast<void>(take(elements * size));
}

bool MessageReader::is_at_end() const {
  const std::size_t filling = is_aligned_ ? sizeof(std::uint32_t) - 1 : 0;
  return body_.size() - std::min(at_, body_.size()) <= filling;
}

std::string MessageReader::text() {
  const std::string_view bytes = take(uint32());
  return std::string(bytes.substr(0, bytes.find('\0')));
}

std::size_t MessageReader::count(std::size_t least) {
  const std::size_t count = uint32();
  if (count > (body_.size() - std::min(at_, body_.size())) / least) {
    throw MessageError("a sequence that is longer than the message");
  }
  return count;
}

std::vector<std::string> MessageReader::texts() {
  std::vector<std::string> all(count(sizeof(std::uint32_t)));
  std::ranges::generate(all, [this] { return text(); });
  return all;
}

std::vector<double> MessageReader::float64s() {
  std::vector<double> all(count(sizeof(double)));
  std::ranges::generate(all, [this] { return float64(); });
  return all;
}

std::optional<double> MessageReader::stamp() {
  if (has_sequence_) {
    static_cast<void>(uint32());
  }
  const double time = seconds();
  static_cast<void>(text());  // the frame
  return time > 0.0 ? std::optional(time) : std::nullopt;
}

double MessageReader::seconds() {
  const std::int32_t whole = int32();
  return static_cast<double>(whole) + 1e-9 * static_cast<double>(uint32());
}

}  // namespace handway::device
