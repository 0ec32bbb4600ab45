#pragma once

#include "handway/sampling/export.h"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <optional>

namespace handway::sampling {

/// Tells whether a point of [0,1]^d is valid (free of collision, for planners).
/// Must answer the same for the same point.
using ValidityPredicate = std::function<bool(const Eigen::VectorXd&)>;

/// A source of points in the unit cube [0,1]^d.
///
/// What is drawn depends only on how the sampler was made, the seed, and how
/// often it was drawn from. Not for use by several threads at once: make one
/// sampler each.
class HANDWAY_SAMPLING_EXPORT Sampler {
 public:
  virtual ~Sampler() = default;
  Sampler(const Sampler&) = delete;
  Sampler& operator=(const Sampler&) = delete;

  /// d.
  [[nodiscard]] int dimension() const { return dimension_; }

  /// The next point, shape [dimension()], or nothing if a sampler that looks for
  /// special points found none within its number of tries; drawing again goes on
  /// looking. Random, Halton and SDK samplers always give a point.
  /// @throws std::logic_error if the derived class breaks its contract.
  [[nodiscard]] std::optional<Eigen::VectorXd> draw();

  /// Starts again with this seed. Sequences without a random part ignore the seed.
  void reset(std::uint64_t seed);

 protected:
  /// @throws std::invalid_argument if dimension < 1.
  explicit Sampler(int dimension);

 private:
  virtual std::optional<Eigen::VectorXd> do_draw() = 0;
  virtual void do_reset(std::uint64_t seed) = 0;

  int dimension_;
};

}  // namespace handway::sampling
