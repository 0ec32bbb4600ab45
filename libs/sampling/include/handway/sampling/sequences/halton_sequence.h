#pragma once

#include "handway/sampling/export.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace handway::sampling {

/// Element `index` of the van der Corput sequence: the radical inverse, the
/// digits of `index` in `base` mirrored at the radix point. Source: van der
/// Corput 1935; Kuipers and Niederreiter, "Uniform Distribution of Sequences".
/// @returns a number in [0, 1): 0, 1/2, 1/4, 3/4, 1/8, … in base 2.
/// @throws std::invalid_argument if base < 2.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT double van_der_corput(std::uint64_t index,
                                                            std::uint32_t base = 2);

/// Position number `index` of the paper's sweep along the segment from start to
/// goal (section 5.1): 0, 1, 1/2, 1/4, 3/4, 1/8, …, the van der Corput sequence
/// with the goal put in second place. For every power of two n, positions
/// 0 … n are the n + 1 multiples of 1/n, each once.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT double sweep_position(std::uint64_t index);

/// Variants of the Halton sequence that help where dimensions are many: with
/// large prime bases, neighbouring coordinates of the plain sequence run along
/// common lines for as many points as the product of their bases.
struct HaltonOptions {
  /// Only every leap-th element is taken (Kocis and Whiten, "Computational
  /// investigations of low-discrepancy sequences", ACM Trans. Math. Softw. 23,
  /// 1997; they advise 31, 61, 149, 409 or 1949). No multiple of a base; 1 takes all.
  std::uint64_t leap = 1;

  /// If set, every base's digits other than 0 are permuted at random by this
  /// seed (after Braaten and Weller, J. Comput. Phys. 32, 1979). Every elementary interval
  /// still gets as many points as in the plain sequence.
  std::optional<std::uint64_t> scramble;
};

/// The Halton sequence: coordinate i is the van der Corput sequence in the i-th
/// prime (Halton, "On the efficiency of certain quasi-random sequences of points
/// in evaluating multi-dimensional integrals", Numer. Math. 2, 1960).
class HANDWAY_SAMPLING_EXPORT HaltonSequence {
 public:
  /// @throws std::invalid_argument if dimension < 1, leap is 0, or leap is a
  /// multiple of one of the first `dimension` primes.
  explicit HaltonSequence(int dimension, HaltonOptions options = {});

  [[nodiscard]] int dimension() const { return static_cast<int>(bases_.size()); }
  [[nodiscard]] const std::vector<std::uint32_t>& bases() const { return bases_; }

  /// Element (index + 1) · leap: the origin, element 0, is left out.
  /// @returns shape [dimension], in [0, 1).
  [[nodiscard]] Eigen::VectorXd point(std::uint64_t index) const;

 private:
  HaltonOptions options_;
  std::vector<std::uint32_t> bases_;
  std::vector<std::vector<std::uint32_t>> permutations_;  ///< Per base, if scrambled.
};

/// The first `count` primes. @throws std::invalid_argument if count < 0.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT std::vector<std::uint32_t> first_primes(int count);

}  // namespace handway::sampling
