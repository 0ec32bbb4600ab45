#include "handway/sampling/samplers/sdk_sampler.h"

namespace handway::sampling {

SdkSampler::SdkSampler(int dimension, int levels)
    : Sampler(dimension), sequence_(dimension, levels) {}

SdkSampler::SdkSampler(int dimension, int levels, std::uint64_t seed)
    : Sampler(dimension), sequence_(dimension, levels), stream_(seed) {}

std::optional<Eigen::VectorXd> SdkSampler::do_draw() {
  const std::uint64_t index = index_++;
  if (!stream_) {
    return sequence_.centre(index);
  }
  return sequence_.corner(index) + sequence_.side() * stream_->uniform(dimension());
}

void SdkSampler::do_reset(std::uint64_t seed) {
  index_ = 0;
  if (stream_) {
    stream_ = RandomStream(seed);
  }
}

}  // namespace handway::sampling
