#include "handway/sampling/samplers/bridge_test_sampler.h"
#include "handway/sampling/samplers/gaussian_sampler.h"
#include "handway/sampling/samplers/halton_sampler.h"
#include "handway/sampling/samplers/random_sampler.h"
#include "handway/sampling/samplers/sdk_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace handway::sampling {
namespace {

using Points = std::vector<std::optional<Eigen::VectorXd>>;

struct SamplerCase {
  std::string name;
  bool seeded;  // do other seeds give other points?
  std::function<std::unique_ptr<Sampler>(int dimension, std::uint64_t seed)> make;
};

// How GoogleTest prints the parameter.
std::ostream& operator<<(std::ostream& out, const SamplerCase& sampler) {
  return out << sampler.name;
}

// A wall across the first axis with a gap on both sides.
bool beside_the_wall(const Eigen::VectorXd& point) { return point[0] < 0.45 || point[0] > 0.55; }

// A thin slot in a block.
bool in_the_slot(const Eigen::VectorXd& point) { return !beside_the_wall(point); }

const std::vector<SamplerCase>& every_sampler() {
  static const std::vector<SamplerCase> kCases = {
      {"Random", true,
       [](int d, std::uint64_t seed) { return std::make_unique<RandomSampler>(d, seed); }},
      {"Halton", false, [](int d, std::uint64_t) { return std::make_unique<HaltonSampler>(d); }},
      {"ScrambledHalton", true,
       [](int d, std::uint64_t seed) {
         return std::make_unique<HaltonSampler>(d, HaltonOptions{1, seed});
       }},
      {"Sdk", false, [](int d, std::uint64_t) { return std::make_unique<SdkSampler>(d, 4); }},
      {"RandomisedSdk", true,
       [](int d, std::uint64_t seed) { return std::make_unique<SdkSampler>(d, 4, seed); }},
      {"Gaussian", true,
       [](int d, std::uint64_t seed) {
         return std::make_unique<GaussianSampler>(d, seed, beside_the_wall);
       }},
      {"BridgeTest", true, [](int d, std::uint64_t seed) {
         return std::make_unique<BridgeTestSampler>(d, seed, in_the_slot,
                                                    BridgeTestOptions{0.1, 20000});
       }}};
  return kCases;
}

Points drawn(Sampler& sampler, int count) {
  Points points;
  for (int i = 0; i < count; ++i) {
    points.push_back(sampler.draw());
  }
  return points;
}

class SamplerContract : public ::testing::TestWithParam<SamplerCase> {};

TEST_P(SamplerContract, DrawsPointsOfTheUnitCube) {
  for (const int dimension : {1, 2, 6, 22}) {
    const auto sampler = GetParam().make(dimension, 1);
    EXPECT_EQ(sampler->dimension(), dimension);
    for (const auto& point : drawn(*sampler, 500)) {
      ASSERT_TRUE(point.has_value());
      ASSERT_EQ(point->size(), dimension);
      ASSERT_GE(point->minCoeff(), 0.0);
      ASSERT_LE(point->maxCoeff(), 1.0);
    }
  }
}

TEST_P(SamplerContract, RepeatsForTheSameSeed) {
  const auto one = GetParam().make(5, 9);
  const auto two = GetParam().make(5, 9);
  EXPECT_EQ(drawn(*one, 100), drawn(*two, 100));
}

TEST_P(SamplerContract, RepeatsAfterReset) {
  const auto sampler = GetParam().make(5, 9);
  const Points first = drawn(*sampler, 100);
  drawn(*sampler, 17);
  sampler->reset(9);
  EXPECT_EQ(drawn(*sampler, 100), first);
}

TEST_P(SamplerContract, MindsTheSeedExactlyIfItHasARandomPart) {
  const auto sampler = GetParam().make(5, 9);
  const Points first = drawn(*sampler, 100);
  sampler->reset(10);
  EXPECT_EQ(drawn(*sampler, 100) != first, GetParam().seeded);
}

TEST_P(SamplerContract, RefusesNoDimensions) {
  EXPECT_THROW(GetParam().make(0, 1), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Every, SamplerContract, ::testing::ValuesIn(every_sampler()),
                         [](const auto& sampler) { return sampler.param.name; });

class BrokenSampler final : public Sampler {
 public:
  explicit BrokenSampler(Eigen::VectorXd point) : Sampler(2), point_(std::move(point)) {}

 private:
  std::optional<Eigen::VectorXd> do_draw() override { return point_; }
  void do_reset(std::uint64_t) override {}

  Eigen::VectorXd point_;
};

TEST(Sampler, CatchesDerivedClassesThatBreakTheContract) {
  EXPECT_THROW(static_cast<void>(BrokenSampler(Eigen::Vector3d::Zero()).draw()), std::logic_error);
  EXPECT_THROW(static_cast<void>(BrokenSampler(Eigen::Vector2d(0.5, 1.1)).draw()),
               std::logic_error);
  EXPECT_THROW(static_cast<void>(BrokenSampler(Eigen::Vector2d(NAN, 0.5)).draw()),
               std::logic_error);
}

}  // namespace
}  // namespace handway::sampling
