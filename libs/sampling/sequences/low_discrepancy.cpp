#include "handway/sampling/sequences/low_discrepancy.h"

#include "handway/sampling/sequences/random_stream.h"

#include <boost/math/special_functions/prime.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <unsupported/Eigen/KroneckerProduct>
#include <utility>

namespace handway::sampling {
namespace {

using Digits = std::vector<std::uint32_t>;

// Digits 1 … base-1 in random order; 0 stays, for it represents the endless zeros before an
// index.
Digits random_permutation(std::uint32_t base, RandomStream stream) {
  Digits digits(base);
  std::iota(digits.begin(), digits.end(), 0u);
  for (std::uint32_t i = base - 1; i > 1; --i) {
    std::swap(digits[i], digits[1 + stream.below(i)]);
  }
  return digits;
}

// The permuted digits of `index`, mirrored at the radix point.
double radical_inverse(std::uint64_t index, const Digits& digits) {
  const auto base = static_cast<std::uint32_t>(digits.size());
  double value = 0.0;
  double weight = 1.0;
  for (; index > 0; index /= base) {
    weight /= base;
    value += weight * digits[index % base];
  }
  // Indices beyond 2^53 can round up to 1.
  return std::min(value, 1.0 - std::numeric_limits<double>::epsilon() / 2.0);
}

int smallest_prime_factor(int n) {
  for (int factor = 2; factor * factor <= n; ++factor) {
    if (n % factor == 0) {
      return factor;
    }
  }
  return n;
}

}  // namespace

double sweep_position(std::uint64_t index) {
  static const Digits kBinary{0, 1};
  return index == 1 ? 1.0 : radical_inverse(index == 0 ? 0 : index - 1, kBinary);
}

HaltonSequence::HaltonSequence(int dimension, std::uint64_t seed) {
  if (dimension < 1) {
    throw std::invalid_argument("a Halton sequence has at least one dimension");
  }
  const RandomStream stream(seed);
  for (unsigned i = 0; i < static_cast<unsigned>(dimension); ++i) {
    const std::uint32_t base = boost::math::prime(i);
    digits_.push_back(random_permutation(base, stream.fork(base)));
  }
}

Eigen::VectorXd HaltonSequence::point(std::uint64_t index) const {
  Eigen::VectorXd coordinates(static_cast<Eigen::Index>(digits_.size()));
  std::ranges::transform(digits_, coordinates.begin(),
                         [&](const Digits& digits) { return radical_inverse(index + 1, digits); });
  return coordinates;
}

Eigen::MatrixXi sdk_matrix(int d) {
  if (d < 1) {
    throw std::invalid_argument("the SDK sequence has at least one dimension");
  }
  if (d == 1) {
    return Eigen::MatrixXi::Ones(1, 1);
  }
  if (d == 2) {
    return (Eigen::MatrixXi(2, 2) << 1, 0, 1, 1).finished();
  }
  if (d == 3) {
    return (Eigen::MatrixXi(3, 3) << 1, 0, 0, 0, 1, 0, 1, 1, 1).finished();
  }
  const int p = smallest_prime_factor(d);
  if (p == d) {
    return sdk_matrix(d + 1).topLeftCorner(d, d);
  }
  return Eigen::kroneckerProduct(sdk_matrix(p), sdk_matrix(d / p));
}

SdkSequence::SdkSequence(int dimension, int levels) : levels_(levels) {
  if (levels < 1 || levels > 52) {
    throw std::invalid_argument("the SDK sequence has 1 to 52 partition levels");
  }
  const Eigen::MatrixXi T = sdk_matrix(dimension);
  rows_.resize(static_cast<std::size_t>(dimension));
  for (int i = 0; i < dimension; ++i) {
    for (int j = 0; j < dimension; ++j) {
      if (T(i, j) != 0) {
        rows_[static_cast<std::size_t>(i)].push_back(j);
      }
    }
  }
}

double SdkSequence::side() const { return std::ldexp(1.0, -levels_); }

Eigen::VectorXd SdkSequence::corner(std::uint64_t index) const {
  constexpr int kIndexBits = 64;
  const int d = dimension();
  Eigen::VectorXd coordinates = Eigen::VectorXd::Zero(d);
  double weight = 0.5;
  for (int level = 0; level < levels_ && level * d < kIndexBits; ++level, weight /= 2.0) {
    for (int i = 0; i < d; ++i) {
      std::uint64_t bit = 0;
      for (const int column : rows_[static_cast<std::size_t>(i)]) {
        const int position = level * d + column;
        bit ^= position < kIndexBits ? (index >> position) & 1u : 0u;
      }
      coordinates[i] += weight * static_cast<double>(bit);
    }
  }
  return coordinates;
}

}  // namespace handway::sampling
