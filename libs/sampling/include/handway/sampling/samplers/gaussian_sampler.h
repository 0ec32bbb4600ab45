#pragma once

#include "handway/sampling/export.h"
#include "handway/sampling/samplers/sampler.h"
#include "handway/sampling/sequences/random_stream.h"

namespace handway::sampling {

struct GaussianSamplerOptions {
  double sigma = 0.1;  ///< Standard deviation of the pair's distance. > 0.
  int tries = 1000;    ///< Pairs looked at in one draw, ≥ 1.
};

/// Valid points near the border of what is valid: a uniform point and a second
/// one at a normally distributed distance in a random direction; if exactly one
/// of them is valid, that one. Pairs that leave the unit cube are thrown away.
/// Source: Boor, Overmars and van der Stappen, "The Gaussian sampling strategy
/// for probabilistic roadmap planners", ICRA 1999.
class HANDWAY_SAMPLING_EXPORT GaussianSampler final : public Sampler {
 public:
  /// @throws std::invalid_argument for a dimension, sigma or number of tries out of range.
  GaussianSampler(int dimension, std::uint64_t seed, ValidityPredicate valid,
                  GaussianSamplerOptions options = {});

 private:
  std::optional<Eigen::VectorXd> do_draw() override;
  void do_reset(std::uint64_t seed) override;

  RandomStream stream_;
  ValidityPredicate valid_;
  GaussianSamplerOptions options_;
};

}  // namespace handway::sampling
