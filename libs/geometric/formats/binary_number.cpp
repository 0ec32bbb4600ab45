#include "formats/binary_number.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace handway::geometric {
namespace {

template <typename Number>
Number number_at(const char* bytes, bool big_endian) {
  std::array<char, sizeof(Number)> copy{};
  std::memcpy(copy.data(), bytes, sizeof(Number));
  if (big_endian) {
    std::ranges::reverse(copy);
  }
  return std::bit_cast<Number>(copy);
}

/// IEEE 754 binary16.
double half_precision(std::uint16_t bits) {
  const int exponent = (bits >> 10) & 0x1F;
  const int fraction = bits & 0x3FF;
  const double size = exponent == 31  ? (fraction == 0 ? std::numeric_limits<double>::infinity()
                                                       : std::numeric_limits<double>::quiet_NaN())
                      : exponent == 0 ? std::ldexp(fraction, -24)
                                      : std::ldexp(1024 + fraction, exponent - 25);
  return (bits & 0x8000) != 0 ? -size : size;
}

template <typename Signed, typename Unsigned>
double integer_at(const char* bytes, bool is_signed, bool big_endian) {
  return is_signed ? static_cast<double>(number_at<Signed>(bytes, big_endian))
                   : static_cast<double>(number_at<Unsigned>(bytes, big_endian));
}

}  // namespace

bool BinaryNumber::is_known() const {
  const bool is_wide = bytes == 2 || bytes == 4 || bytes == 8;
  return kind == 'f' ? is_wide : (kind == 'i' || kind == 'u') && (is_wide || bytes == 1);
}

double BinaryNumber::value(const char* at) const {
  if (kind == 'f') {
    return bytes == 8   ? number_at<double>(at, big_endian)
           : bytes == 4 ? static_cast<double>(number_at<float>(at, big_endian))
                        : half_precision(number_at<std::uint16_t>(at, big_endian));
  }
  const bool is_signed = kind == 'i';
  switch (bytes) {
    case 8:
      return integer_at<std::int64_t, std::uint64_t>(at, is_signed, big_endian);
    case 4:
      return integer_at<std::int32_t, std::uint32_t>(at, is_signed, big_endian);
    case 2:
      return integer_at<std::int16_t, std::uint16_t>(at, is_signed, big_endian);
    default:
      return integer_at<std::int8_t, std::uint8_t>(at, is_signed, big_endian);
  }
}

}  // namespace handway::geometric
