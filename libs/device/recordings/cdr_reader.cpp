#include "recordings/cdr_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace handway::device {
namespace {

constexpr std::size_t kEncapsulation = 4;

}  // namespace

CdrReader::CdrReader(std::string_view message) {
  if (message.size() < kEncapsulation || message[0] != 0 || (message[1] != 0 && message[1] != 1)) {
    throw CdrError("an encoding other than CDR");
  }
  big_endian_ = message[1] == 0;
  body_ = message.substr(kEncapsulation);
}

std::string_view CdrReader::take(std::size_t size) {
  if (size > body_.size() - std::min(at_, body_.size())) {
    throw CdrError("an end within a field");
  }
  const std::string_view bytes = body_.substr(at_, size);
  at_ += size;
  return bytes;
}

// A number begins at a multiple of its size.
template <typename Number>
Number CdrReader::number() {
  at_ = (at_ + sizeof(Number) - 1) / sizeof(Number) * sizeof(Number);
  const std::string_view bytes = take(sizeof(Number));
  std::array<char, sizeof(Number)> copy{};
  std::memcpy(copy.data(), bytes.data(), copy.size());
  if (big_endian_) {
    std::ranges::reverse(copy);
  }
  return std::bit_cast<Number>(copy);
}

std::int32_t CdrReader::int32() { return number<std::int32_t>(); }

std::uint32_t CdrReader::uint32() { return number<std::uint32_t>(); }

double CdrReader::float64() { return number<double>(); }

std::string CdrReader::text() {
  const std::string_view bytes = take(uint32());
  return std::string(bytes.substr(0, bytes.find('\0')));
}

std::size_t CdrReader::count(std::size_t least) {
  const std::size_t count = uint32();
  if (count > (body_.size() - at_) / least) {
    throw CdrError("a sequence that is longer than the message");
  }
  return count;
}

std::vector<std::string> CdrReader::texts() {
  std::vector<std::string> all(count(sizeof(std::uint32_t)));
  std::ranges::generate(all, [this] { return text(); });
  return all;
}

std::vector<double> CdrReader::float64s() {
  std::vector<double> all(count(sizeof(double)));
  std::ranges::generate(all, [this] { return float64(); });
  return all;
}

double CdrReader::seconds() {
  const std::int32_t whole = int32();
  return static_cast<double>(whole) + 1e-9 * static_cast<double>(uint32());
}

}  // namespace handway::device
