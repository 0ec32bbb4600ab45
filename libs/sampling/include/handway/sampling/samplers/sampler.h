#pragma once

#include "handway/sampling/export.h"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace handway::sampling {

/// A source of points in the unit cube [0,1]^d.
///
/// A point depends on the sampler's construction and on its index alone: points may be requested in
/// any order, and threads may share a sampler.
class Sampler {
 public:
  /// The point of an index, shape [dimension].
  using Points = std::function<Eigen::VectorXd(std::uint64_t index)>;

  Sampler(int dimension, Points points) : dimension_(dimension), points_(std::move(points)) {}

  /// d.
  [[nodiscard]] int dimension() const { return dimension_; }
  /// Point `index`, shape [dimension()].
  [[nodiscard]] Eigen::VectorXd point(std::uint64_t index) const { return points_(index); }

 private:
  int dimension_;
  Points points_;
};

/// Predicate: true if a point of [0,1]^d is valid (free of collision, for planners). Deterministic,
/// and thread-safe if the sampler is shared.
using ValidityPredicate = std::function<bool(const Eigen::VectorXd&)>;

/// Method of choosing points.
enum class SamplerKind {
  kRandom,      ///< Uniform.
  kHalton,      ///< The Halton sequence, its digits permuted by the seed.
  kSdk,         ///< One point in each cell of the SDK sequence, at random within it.
  kGaussian,    ///< Near the border of the valid points.
  kBridgeTest,  ///< In narrow passages.
};

/// Names, in the order of SamplerKind: "random", "halton", …
[[nodiscard]] HANDWAY_SAMPLING_EXPORT const std::vector<std::string>& sampler_names();

/// Options of the Gaussian sampler and the bridge test.
struct PairOptions {
  double sigma = 0.1;  ///< Standard deviation of the distance of a pair of points. > 0.
  int tries = 20;      ///< Pairs tried for one point, ≥ 1. After them: a uniform point.
};

/// Sources:
/// - Halton, "On the efficiency of certain quasi-random sequences of points in evaluating
///   multi-dimensional integrals", Numer. Math. 2, 1960; permuted, see HaltonSequence.
/// - Rosell, Roa, Pérez, García, "A general deterministic sequence for sampling d-dimensional
///   configuration spaces", J. Intell. Robot. Syst. 50(4), 2007.
/// - Boor, Overmars, van der Stappen, "The Gaussian sampling strategy for probabilistic roadmap
///   planners", ICRA 1999: of a uniform point and one at a normally distributed distance from it,
///   the valid one if exactly one is.
/// - Hsu, Jiang, Reif, Sun, "The bridge test for sampling narrow passages with probabilistic
///   roadmap planners", ICRA 2003: the valid middle of two invalid points.
/// @param valid needed by kGaussian and kBridgeTest alone.
/// @throws std::invalid_argument if dimension < 1, `valid` is missing, or `options` are out of
/// range.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT std::unique_ptr<Sampler> make_sampler(
    SamplerKind kind, int dimension, std::uint64_t seed, ValidityPredicate valid = {},
    PairOptions options = {});

}  // namespace handway::sampling
