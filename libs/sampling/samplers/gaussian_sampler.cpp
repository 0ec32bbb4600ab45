#include "handway/sampling/samplers/gaussian_sampler.h"

#include "samplers/unit_cube.h"

#include <stdexcept>
#include <utility>

namespace handway::sampling {

GaussianSampler::GaussianSampler(int dimension, std::uint64_t seed, ValidityPredicate valid,
                                 GaussianSamplerOptions options)
    : Sampler(dimension), stream_(seed), valid_(std::move(valid)), options_(options) {
  if (!(options_.sigma > 0.0) || options_.tries < 1 || !valid_) {
    throw std::invalid_argument(
        "a Gaussian sampler needs a sigma above 0, at least one try and a predicate");
  }
}

std::optional<Eigen::VectorXd> GaussianSampler::do_draw() {
  for (int i = 0; i < options_.tries; ++i) {
    Eigen::VectorXd one = stream_.uniform(dimension());
    const Eigen::VectorXd direction = random_direction(stream_, dimension());
    Eigen::VectorXd two = one + options_.sigma * stream_.normal() * direction;
    if (!in_unit_cube(two)) {
      continue;
    }
    const bool one_valid = valid_(one);
    if (one_valid != valid_(two)) {
      return one_valid ? one : two;
    }
  }
  return std::nullopt;
}

void GaussianSampler::do_reset(std::uint64_t seed) { stream_ = RandomStream(seed); }

}  // namespace handway::sampling
