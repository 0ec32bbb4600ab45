#include "handway/sampling/samplers/random_sampler.h"

namespace handway::sampling {

RandomSampler::RandomSampler(int dimension, std::uint64_t seed)
    : Sampler(dimension), stream_(seed) {}

std::optional<Eigen::VectorXd> RandomSampler::do_draw() { return stream_.uniform(dimension()); }

void RandomSampler::do_reset(std::uint64_t seed) { stream_ = RandomStream(seed); }

}  // namespace handway::sampling
