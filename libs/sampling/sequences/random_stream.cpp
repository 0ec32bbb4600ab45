#include "handway/sampling/sequences/random_stream.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace handway::sampling {
namespace {

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;  // 2^64 / golden ratio

// SplitMix64's output function: a bijection whose bits all depend on all input bits.
std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

// ln x for x > 0. std::log may differ in the last bit between C libraries. With
// x = m 2^e, m in [√½, √2): ln m = 2 artanh(s), s = (m-1)/(m+1), |s| < 0.172, so
// that the series' term number 12 is below 1e-19.
double natural_logarithm(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752) {
    m *= 2.0;
    --exponent;
  }
  const double s = (m - 1.0) / (m + 1.0);
  const double s2 = s * s;
  double sum = 0.0;
  for (int k = 23; k >= 1; k -= 2) {
    sum = sum * s2 + 1.0 / k;
  }
  return exponent * 0.69314718055994531 + 2.0 * s * sum;
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed) : seed_(seed) {
  std::uint64_t counter = seed;
  for (std::uint64_t& word : state_) {
    counter += kGolden;
    word = mixed(counter);
  }
}

RandomStream RandomStream::fork(std::uint64_t index) const {
  return RandomStream(mixed(mixed(seed_ + kGolden) ^ mixed(index + 2 * kGolden)));
}

Eigen::VectorXd RandomStream::uniform(int size) {
  Eigen::VectorXd values(size);
  std::ranges::generate(values, [this] { return uniform(); });
  return values;
}

std::uint64_t RandomStream::below(std::uint64_t n) {
  if (n == 0) {
    throw std::invalid_argument("no number is below 0");
  }
  const std::uint64_t mask = n == 1 ? 0 : ~std::uint64_t{0} >> std::countl_zero(n - 1);
  for (;;) {
    const std::uint64_t candidate = bits() & mask;
    if (candidate < n) {
      return candidate;
    }
  }
}

double RandomStream::normal() {
  for (;;) {
    const double x = 2.0 * uniform() - 1.0;
    const double y = 2.0 * uniform() - 1.0;
    const double s = x * x + y * y;
    if (s > 0.0 && s < 1.0) {
      return x * std::sqrt(-2.0 * natural_logarithm(s) / s);
    }
  }
}

Eigen::VectorXd RandomStream::normal(int size) {
  Eigen::VectorXd values(size);
  std::ranges::generate(values, [this] { return normal(); });
  return values;
}

}  // namespace handway::sampling
