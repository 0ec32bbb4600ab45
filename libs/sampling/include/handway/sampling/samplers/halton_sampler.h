#pragma once

#include "handway/sampling/export.h"
#include "handway/sampling/samplers/sampler.h"
#include "handway/sampling/sequences/halton_sequence.h"

namespace handway::sampling {

/// The points of a Halton sequence, one after the other.
class HANDWAY_SAMPLING_EXPORT HaltonSampler final : public Sampler {
 public:
  /// With a scramble in `options`, reset() scrambles anew by its seed; without
  /// one, it starts the same points again.
  /// @throws std::invalid_argument as HaltonSequence does.
  explicit HaltonSampler(int dimension, HaltonOptions options = {});

 private:
  std::optional<Eigen::VectorXd> do_draw() override;
  void do_reset(std::uint64_t seed) override;

  HaltonOptions options_;
  HaltonSequence sequence_;
  std::uint64_t index_ = 0;
};

}  // namespace handway::sampling
