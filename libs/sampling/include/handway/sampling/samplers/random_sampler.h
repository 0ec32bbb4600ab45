#pragma once

#include "handway/sampling/export.h"
#include "handway/sampling/samplers/sampler.h"
#include "handway/sampling/sequences/random_stream.h"

namespace handway::sampling {

/// Uniform random points.
class HANDWAY_SAMPLING_EXPORT RandomSampler final : public Sampler {
 public:
  RandomSampler(int dimension, std::uint64_t seed);

 private:
  std::optional<Eigen::VectorXd> do_draw() override;
  void do_reset(std::uint64_t seed) override;

  RandomStream stream_;
};

}  // namespace handway::sampling
