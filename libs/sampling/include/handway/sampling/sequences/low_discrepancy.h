#pragma once

#include "handway/sampling/export.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

/// @file
/// Sequences of points that fill a space evenly.
namespace handway::sampling {

/// Position number `index` of the paper's sweep along the segment from start to
/// goal (section 5.1): 0, 1, 1/2, 1/4, 3/4, 1/8, …, the van der Corput sequence (1935: the binary
/// digits mirrored at the radix point) with the goal put in second place. For every power of two n,
/// positions 0 … n are the n + 1 multiples of 1/n, each once.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT double sweep_position(std::uint64_t index);

/// The Halton sequence: coordinate i is the index with its digits in the i-th prime mirrored at the
/// radix point (Halton, "On the efficiency of certain quasi-random sequences of points
/// in evaluating multi-dimensional integrals", Numer. Math. 2, 1960).
///
/// With large bases neighbouring coordinates would be on common lines for as many points as the
/// product of their bases. So every base's digits but 0 are permuted at random (after Braaten and
/// Weller, J. Comput. Phys. 32, 1979). Every elementary interval still gets equally many points.
class HANDWAY_SAMPLING_EXPORT HaltonSequence {
 public:
  /// @param seed of the permutations.
  /// @throws std::invalid_argument if dimension < 1.
  HaltonSequence(int dimension, std::uint64_t seed);

  /// Element index + 1: the origin, element 0, is left out.
  /// @returns shape [dimension], in [0, 1).
  [[nodiscard]] Eigen::VectorXd point(std::uint64_t index) const;

 private:
  std::vector<std::vector<std::uint32_t>> digits_;  ///< Permuted digits of each base.
};

/// The deterministic sampling sequence s_d(k) of Rosell, Roa, Pérez and García,
/// "A general deterministic sequence for sampling d-dimensional configuration
/// spaces", J. Intell. Robot. Syst. 50(4), 2007, pp. 361-373.
///
/// It orders the cells of a grid with 2^M cells per axis. The index k is written
/// in M digits of d bits. Digit j (j = 0: the least significant) is read as a
/// binary vector v_j, bit i belonging to axis i, and T_d v_j (mod 2) chooses one
/// of the 2^d subcells of partition level j + 1: bit i is the bit of
/// weight 2^(M-1-j) of the cell's coordinate on axis i. So the first 2^(d l)
/// indices visit every cell of level l once, for every l ≤ M: the sequence is
/// incremental and uniform. The d × d binary matrix T_d makes successive cells
/// far from those before them:
///
///     T_1 = 1,  T_2 = 1 0   T_3 = 1 0 0
///                    1 1         0 1 0
///                                1 1 1,
///     T_(p q) = T_p ⊗ T_q, over the prime factors in rising order,
///     T_p for a prime p > 3: the first p rows and columns of T_(p+1).
///
/// If d has no prime factor above 3, any two of the first 2^(d-1) cells of level 1 differ in two
/// axes or more.
///
/// From index 2^(d M) on the cells repeat.
class HANDWAY_SAMPLING_EXPORT SdkSequence {
 public:
  /// @param dimension d ≥ 1. @param levels M in [1, 52].
  /// @throws std::invalid_argument if either is out of range.
  SdkSequence(int dimension, int levels);

  [[nodiscard]] int dimension() const { return static_cast<int>(rows_.size()); }

  /// Length of a cell's side, 2^-M.
  [[nodiscard]] double side() const;

  /// The corner nearest to the origin of the cell with this index: shape
  /// [dimension], multiples of side() in [0, 1).
  [[nodiscard]] Eigen::VectorXd corner(std::uint64_t index) const;

 private:
  using ColumnIndices = std::vector<int>;

  std::vector<ColumnIndices> rows_;  ///< Per row of T_d, the columns that hold a 1.
  int levels_;
};

/// T_d, shape [d, d], entries 0 and 1; lower triangular with ones on the
/// diagonal, hence invertible modulo 2. @throws std::invalid_argument if d < 1.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT Eigen::MatrixXi sdk_matrix(int d);

}  // namespace handway::sampling
