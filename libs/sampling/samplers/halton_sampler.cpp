#include "handway/sampling/samplers/halton_sampler.h"

namespace handway::sampling {

HaltonSampler::HaltonSampler(int dimension, HaltonOptions options)
    : Sampler(dimension), options_(options), sequence_(dimension, options) {}

std::optional<Eigen::VectorXd> HaltonSampler::do_draw() { return sequence_.point(index_++); }

void HaltonSampler::do_reset(std::uint64_t seed) {
  index_ = 0;
  if (options_.scramble) {
    options_.scramble = seed;
    sequence_ = HaltonSequence(dimension(), options_);
  }
}

}  // namespace handway::sampling
