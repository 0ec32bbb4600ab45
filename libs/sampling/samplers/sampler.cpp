#include "handway/sampling/samplers/sampler.h"

#include "handway/sampling/sequences/low_discrepancy.h"
#include "handway/sampling/sequences/random_stream.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace handway::sampling {
namespace {

bool in_unit_cube(const Eigen::VectorXd& point) {
  return (point.array() >= 0.0 && point.array() <= 1.0).all();
}

/// Function that makes a valid point from a pair of points, or nothing.
using TryPair = std::optional<Eigen::VectorXd> (*)(RandomStream& stream, int dimension,
                                                   double sigma, const ValidityPredicate& valid);

// Pairs that leave the unit cube are discarded.
std::optional<Eigen::VectorXd> at_the_border(RandomStream& stream, int dimension, double sigma,
                                             const ValidityPredicate& valid) {
  const Eigen::VectorXd one = stream.uniform(dimension);
  const Eigen::VectorXd direction = stream.normal(dimension).normalized();
  const Eigen::VectorXd two = one + sigma * stream.normal() * direction;
  if (!in_unit_cube(two)) {
    return std::nullopt;
  }
  const bool one_valid = valid(one);
  return one_valid == valid(two) ? std::nullopt : std::optional(one_valid ? one : two);
}

std::optional<Eigen::VectorXd> on_a_bridge(RandomStream& stream, int dimension, double sigma,
                                           const ValidityPredicate& valid) {
  const Eigen::VectorXd one = stream.uniform(dimension);
  if (valid(one)) {
    return std::nullopt;
  }
  const Eigen::VectorXd two = one + sigma * stream.normal(dimension);
  if (!in_unit_cube(two) || valid(two)) {
    return std::nullopt;
  }
  const Eigen::VectorXd middle = 0.5 * (one + two);
  return valid(middle) ? std::optional(middle) : std::nullopt;
}

/// Tries pairs of points until one gives a valid point.
Sampler::Points from_pairs(int dimension, std::uint64_t seed, ValidityPredicate valid,
                           PairOptions options, TryPair try_pair) {
  if (!(options.sigma > 0.0) || options.tries < 1 || !valid) {
    throw std::invalid_argument(
        "a sampler of pairs needs a sigma above 0, at least one try and a predicate");
  }
  return [=, valid = std::move(valid)](std::uint64_t index) {
    RandomStream stream = RandomStream(seed).fork(index);
    for (int i = 0; i < options.tries; ++i) {
      if (std::optional<Eigen::VectorXd> point =
              try_pair(stream, dimension, options.sigma, valid)) {
        return *std::move(point);
      }
    }
    return stream.uniform(dimension);
  };
}

Sampler::Points points_of(SamplerKind kind, int dimension, std::uint64_t seed,
                          ValidityPredicate valid, PairOptions options) {
  switch (kind) {
    case SamplerKind::kHalton:
      return [sequence = HaltonSequence(dimension, seed)](std::uint64_t index) {
        return sequence.point(index);
      };
    case SamplerKind::kSdk: {
      const int levels = std::max(1, 20 / dimension);  // about a million points visit all cells
      return [sequence = SdkSequence(dimension, levels),
              stream = RandomStream(seed)](std::uint64_t index) -> Eigen::VectorXd {
        return sequence.corner(index) +
               sequence.side() * stream.fork(index).uniform(sequence.dimension());
      };
    }
    case SamplerKind::kGaussian:
      return from_pairs(dimension, seed, std::move(valid), options, at_the_border);
    case SamplerKind::kBridgeTest:
      return from_pairs(dimension, seed, std::move(valid), options, on_a_bridge);
    default:
      return [dimension, stream = RandomStream(seed)](std::uint64_t index) {
        return stream.fork(index).uniform(dimension);
      };
  }
}

}  // namespace

const std::vector<std::string>& sampler_names() {
  static const std::vector<std::string> kNames = {"random", "halton", "sdk", "gaussian",
                                                  "bridge-test"};
  return kNames;
}

std::unique_ptr<Sampler> make_sampler(SamplerKind kind, int dimension, std::uint64_t seed,
                                      ValidityPredicate valid, PairOptions options) {
  if (dimension < 1) {
    throw std::invalid_argument("a sampler has at least one dimension");
  }
  return std::make_unique<Sampler>(dimension,
                                   points_of(kind, dimension, seed, std::move(valid), options));
}

}  // namespace handway::sampling
