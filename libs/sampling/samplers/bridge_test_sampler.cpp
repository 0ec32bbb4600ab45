#include "handway/sampling/samplers/bridge_test_sampler.h"

#include "samplers/unit_cube.h"

#include <stdexcept>
#include <utility>

namespace handway::sampling {

BridgeTestSampler::BridgeTestSampler(int dimension, std::uint64_t seed, ValidityPredicate valid,
                                     BridgeTestOptions options)
    : Sampler(dimension), stream_(seed), valid_(std::move(valid)), options_(options) {
  if (!(options_.sigma > 0.0) || options_.tries < 1 || !valid_) {
    throw std::invalid_argument(
        "a bridge test needs a sigma above 0, at least one try and a predicate");
  }
}

std::optional<Eigen::VectorXd> BridgeTestSampler::do_draw() {
  for (int i = 0; i < options_.tries; ++i) {
    const Eigen::VectorXd one = stream_.uniform(dimension());
    if (valid_(one)) {
      continue;
    }
    const Eigen::VectorXd two = one + options_.sigma * stream_.normal(dimension());
    if (!in_unit_cube(two) || valid_(two)) {
      continue;
    }
    Eigen::VectorXd middle = 0.5 * (one + two);
    if (valid_(middle)) {
      return middle;
    }
  }
  return std::nullopt;
}

void BridgeTestSampler::do_reset(std::uint64_t seed) { stream_ = RandomStream(seed); }

}  // namespace handway::sampling
