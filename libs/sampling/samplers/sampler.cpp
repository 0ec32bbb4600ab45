#include "handway/sampling/samplers/sampler.h"

#include "handway/sampling/sequences/low_discrepancy.h"
#include "handway/sampling/sequences/random_stream.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

namespace handway::sampling {
namespace {

bool in_unit_cube(const Eigen::VectorXd& point) {
  return (point.array() >= 0.0 && point.array() <= 1.0).all();
}

class RandomSampler final : public Sampler {
 public:
  RandomSampler(int dimension, std::uint64_t seed) : Sampler(dimension), stream_(seed) {}

 private:
  [[nodiscard]] Eigen::VectorXd do_point(std::uint64_t index) const override {
    return stream_.fork(index).uniform(dimension());
  }

  RandomStream stream_;
};

class HaltonSampler final : public Sampler {
 public:
  HaltonSampler(int dimension, std::uint64_t seed)
      : Sampler(dimension), sequence_(dimension, seed) {}

 private:
  [[nodiscard]] Eigen::VectorXd do_point(std::uint64_t index) const override {
    return sequence_.point(index);
  }

  HaltonSequence sequence_;
};

class SdkSampler final : public Sampler {
 public:
  SdkSampler(int dimension, std::uint64_t seed)
      : Sampler(dimension), sequence_(dimension, levels(dimension)), stream_(seed) {}

 private:
  // The first million points or so visit every cell once.
  static int levels(int dimension) { return std::max(1, 20 / dimension); }

  [[nodiscard]] Eigen::VectorXd do_point(std::uint64_t index) const override {
    return sequence_.corner(index) + sequence_.side() * stream_.fork(index).uniform(dimension());
  }

  SdkSequence sequence_;
  RandomStream stream_;
};

/// Looks at pairs of points until one pair leads to a valid point.
class PairSampler : public Sampler {
 public:
  PairSampler(int dimension, std::uint64_t seed, ValidityPredicate valid, PairOptions options)
      : Sampler(dimension), stream_(seed), valid_(std::move(valid)), options_(options) {
    if (!(options_.sigma > 0.0) || options_.tries < 1 || !valid_) {
      throw std::invalid_argument(
          "a sampler of pairs needs a sigma above 0, at least one try and a predicate");
    }
  }

 protected:
  [[nodiscard]] bool valid(const Eigen::VectorXd& point) const { return valid_(point); }
  [[nodiscard]] double sigma() const { return options_.sigma; }

 private:
  [[nodiscard]] Eigen::VectorXd do_point(std::uint64_t index) const final {
    RandomStream stream = stream_.fork(index);
    for (int i = 0; i < options_.tries; ++i) {
      if (std::optional<Eigen::VectorXd> point = try_pair(stream)) {
        return *std::move(point);
      }
    }
    return stream.uniform(dimension());
  }

  [[nodiscard]] virtual std::optional<Eigen::VectorXd> try_pair(RandomStream& stream) const = 0;

  RandomStream stream_;
  ValidityPredicate valid_;
  PairOptions options_;
};

class GaussianSampler final : public PairSampler {
 public:
  using PairSampler::PairSampler;

 private:
  // Pairs that leave the unit cube are thrown away.
  [[nodiscard]] std::optional<Eigen::VectorXd> try_pair(RandomStream& stream) const override {
    const Eigen::VectorXd one = stream.uniform(dimension());
    const Eigen::VectorXd direction = stream.normal(dimension()).normalized();
    const Eigen::VectorXd two = one + sigma() * stream.normal() * direction;
    if (!in_unit_cube(two)) {
      return std::nullopt;
    }
    const bool one_valid = valid(one);
    if (one_valid == valid(two)) {
      return std::nullopt;
    }
    return one_valid ? one : two;
  }
};

class BridgeTestSampler final : public PairSampler {
 public:
  using PairSampler::PairSampler;

 private:
  [[nodiscard]] std::optional<Eigen::VectorXd> try_pair(RandomStream& stream) const override {
    const Eigen::VectorXd one = stream.uniform(dimension());
    if (valid(one)) {
      return std::nullopt;
    }
    const Eigen::VectorXd two = one + sigma() * stream.normal(dimension());
    if (!in_unit_cube(two) || valid(two)) {
      return std::nullopt;
    }
    Eigen::VectorXd middle = 0.5 * (one + two);
    return valid(middle) ? std::optional(std::move(middle)) : std::nullopt;
  }
};

}  // namespace

Sampler::Sampler(int dimension) : dimension_(dimension) {
  if (dimension < 1) {
    throw std::invalid_argument("a sampler has at least one dimension");
  }
}

Eigen::VectorXd Sampler::point(std::uint64_t index) const {
  Eigen::VectorXd point = do_point(index);
  if (point.size() != dimension_) {
    throw std::logic_error("a sampler chose " + std::to_string(point.size()) +
                           " coordinates, expected " + std::to_string(dimension_));
  }
  if (!in_unit_cube(point)) {
    throw std::logic_error("a sampler chose a point outside of the unit cube");
  }
  return point;
}

const std::vector<std::string>& sampler_names() {
  static const std::vector<std::string> kNames = {"random", "halton", "sdk", "gaussian",
                                                  "bridge-test"};
  return kNames;
}

std::unique_ptr<Sampler> make_sampler(SamplerKind kind, int dimension, std::uint64_t seed,
                                      ValidityPredicate valid, PairOptions options) {
  switch (kind) {
    case SamplerKind::kHalton:
      return std::make_unique<HaltonSampler>(dimension, seed);
    case SamplerKind::kSdk:
      return std::make_unique<SdkSampler>(dimension, seed);
    case SamplerKind::kGaussian:
      return std::make_unique<GaussianSampler>(dimension, seed, std::move(valid), options);
    case SamplerKind::kBridgeTest:
      return std::make_unique<BridgeTestSampler>(dimension, seed, std::move(valid), options);
    default:
      return std::make_unique<RandomSampler>(dimension, seed);
  }
}

}  // namespace handway::sampling
