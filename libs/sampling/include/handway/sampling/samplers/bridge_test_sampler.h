#pragma once

#include "handway/sampling/export.h"
#include "handway/sampling/samplers/sampler.h"
#include "handway/sampling/sequences/random_stream.h"

namespace handway::sampling {

struct BridgeTestOptions {
  double sigma = 0.1;  ///< Standard deviation of the far end, per coordinate. > 0.
  int tries = 1000;    ///< Bridges looked at in one draw, ≥ 1.
};

/// Valid points in narrow passages: the middle of a bridge between an invalid
/// uniform point and a second invalid point drawn from the normal distribution
/// around it. Bridges that leave the unit cube are thrown away.
/// Source: Hsu, Jiang, Reif and Sun, "The bridge test for sampling narrow
/// passages with probabilistic roadmap planners", ICRA 2003.
class HANDWAY_SAMPLING_EXPORT BridgeTestSampler final : public Sampler {
 public:
  /// @throws std::invalid_argument for a dimension, sigma or number of tries out of range.
  BridgeTestSampler(int dimension, std::uint64_t seed, ValidityPredicate valid,
                    BridgeTestOptions options = {});

 private:
  std::optional<Eigen::VectorXd> do_draw() override;
  void do_reset(std::uint64_t seed) override;

  RandomStream stream_;
  ValidityPredicate valid_;
  BridgeTestOptions options_;
};

}  // namespace handway::sampling
