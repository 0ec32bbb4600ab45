#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>

namespace handway::device {

/// Random numbers that are the same for the same seed everywhere: the distributions of the
/// standard library differ from one to the next, these don't.
class SeededRandom {
 public:
  explicit SeededRandom(std::uint64_t seed) : bits_(seed) {}

  /// From 0 up to, but not, 1.
  double uniform() { return static_cast<double>(bits_() >> 11U) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Of mean 0 and standard deviation 1.
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

  /// From 0 to `size` - 1.
  std::size_t index(std::size_t size) { return bits_() % size; }

  std::uint64_t bits() { return bits_(); }

 private:
  std::mt19937_64 bits_;
};

}  // namespace handway::device
