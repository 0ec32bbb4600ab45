#pragma once

#include "handway/sampling/export.h"

#include <Eigen/Core>

#include <array>
#include <bit>
#include <cstdint>

namespace handway::sampling {

/// A source of pseudo-random numbers, bitwise the same on every platform and in every run:
/// xoshiro256++ 1.0 (Blackman and Vigna, "Scrambled linear pseudorandom number generators", ACM
/// Trans. Math. Softw. 47, 2021, doi:10.1145/3460772), its state filled by SplitMix64 from the
/// seed.
///
/// Work that is shared among threads takes one fork per unit of work, so that the numbers do not
/// depend on the thread or the time.
class HANDWAY_SAMPLING_EXPORT RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed);

  /// The stream with number `index` of this stream's seed. It depends on the seed and the
  /// index alone, not on numbers drawn before, and forks of forks differ by their order of
  /// indices.
  [[nodiscard]] RandomStream fork(std::uint64_t index) const;

  [[nodiscard]] std::uint64_t seed() const { return seed_; }

  /// 64 random bits.
  std::uint64_t bits() {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

  /// Independent uniform values in [0, 1), drawn in order of the index.
  /// @param size ≥ 0. @returns shape [size].
  Eigen::VectorXd uniform(int size);

  /// Uniform in {0, …, n-1}, without bias. @throws std::invalid_argument if n is 0.
  std::uint64_t below(std::uint64_t n);

  /// Normal with mean 0 and variance 1, by Marsaglia's polar method with its own logarithm: only
  /// IEEE basic operations, so that all platforms agree.
  double normal();

  /// Independent normal values, drawn in order of the index. @param size ≥ 0. @returns shape
  /// [size].
  Eigen::VectorXd normal(int size);

 private:
  std::uint64_t seed_;
  std::array<std::uint64_t, 4> state_;
};

}  // namespace handway::sampling
