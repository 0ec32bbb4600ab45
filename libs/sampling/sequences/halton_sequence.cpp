#include "handway/sampling/sequences/halton_sequence.h"

#include "handway/sampling/sequences/random_stream.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

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

namespace {

// Digits 1 … base-1 in random order; 0 stays, for it stands for the endless
// zeros before an index.
std::vector<std::uint32_t> random_permutation(std::uint32_t base, RandomStream stream) {
  std::vector<std::uint32_t> digits(base);
  std::iota(digits.begin(), digits.end(), 0u);
  for (std::uint32_t i = base - 1; i > 1; --i) {
    std::swap(digits[i], digits[1 + stream.below(i)]);
  }
  return digits;
}

double permuted_radical_inverse(std::uint64_t index, const std::vector<std::uint32_t>& digits) {
  const auto base = static_cast<std::uint32_t>(digits.size());
  double value = 0.0;
  double weight = 1.0;
  for (; index > 0; index /= base) {
    weight /= base;
    value += weight * digits[index % base];
  }
  return std::min(value, 1.0 - std::numeric_limits<double>::epsilon() / 2.0);
}

}  // namespace

std::vector<std::uint32_t> first_primes(int count) {
  if (count < 0) {
    throw std::invalid_argument("the number of primes can't be negative");
  }
  std::vector<std::uint32_t> primes;
  for (std::uint32_t candidate = 2; primes.size() < static_cast<std::size_t>(count); ++candidate) {
    const bool composite = std::any_of(primes.begin(), primes.end(),
                                       [&](std::uint32_t prime) { return candidate % prime == 0; });
    if (!composite) {
      primes.push_back(candidate);
    }
  }
  return primes;
}

HaltonSequence::HaltonSequence(int dimension, HaltonOptions options) : options_(options) {
  if (dimension < 1) {
    throw std::invalid_argument("a Halton sequence has at least one dimension");
  }
  bases_ = first_primes(dimension);
  for (const std::uint32_t base : bases_) {
    if (options_.leap % base == 0) {
      throw std::invalid_argument("leap " + std::to_string(options_.leap) +
                                  " is a multiple of the base " + std::to_string(base));
    }
  }
  if (options_.scramble) {
    const RandomStream stream(*options_.scramble);
    for (const std::uint32_t base : bases_) {
      permutations_.push_back(random_permutation(base, stream.fork(base)));
    }
  }
}

Eigen::VectorXd HaltonSequence::point(std::uint64_t index) const {
  const std::uint64_t element = (index + 1) * options_.leap;
  Eigen::VectorXd coordinates(dimension());
  for (std::size_t i = 0; i < bases_.size(); ++i) {
    coordinates[static_cast<Eigen::Index>(i)] =
        permutations_.empty() ? van_der_corput(element, bases_[i])
                              : permuted_radical_inverse(element, permutations_[i]);
  }
  return coordinates;
}

}  // namespace handway::sampling
