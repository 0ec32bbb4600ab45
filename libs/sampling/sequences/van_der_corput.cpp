#include "handway/sampling/sequences/van_der_corput.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace handway::sampling {

double van_der_corput(std::uint64_t index, std::uint32_t base) {
  if (base < 2) {
    throw std::invalid_argument("a number system needs a base of 2 or more");
  }
  double value = 0.0;
  double weight = 1.0;
  for (; index > 0; index /= base) {
    weight /= base;
    value += weight * static_cast<double>(index % base);
  }
  // Indices beyond 2^53 can round up to 1.
  return std::min(value, 1.0 - std::numeric_limits<double>::epsilon() / 2.0);
}

double sweep_position(std::uint64_t index) {
  if (index == 1) {
    return 1.0;
  }
  return van_der_corput(index == 0 ? 0 : index - 1);
}

}  // namespace handway::sampling
