#include "handway/sampling/samplers/sampler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace handway::sampling {
namespace {

using Points = std::vector<Eigen::VectorXd>;

// A wall across the first axis with a gap on both sides.
bool beside_the_wall(const Eigen::VectorXd& point) { return point[0] < 0.45 || point[0] > 0.55; }

// A thin slot in a block.
bool in_the_slot(const Eigen::VectorXd& point) { return std::abs(point[0] - 0.5) < 0.02; }

bool in_the_left_half(const Eigen::VectorXd& point) { return point[0] < 0.5; }

class EverySampler : public ::testing::TestWithParam<SamplerKind> {
 protected:
  static std::unique_ptr<Sampler> make(int dimension, std::uint64_t seed) {
    const bool bridge = GetParam() == SamplerKind::kBridgeTest;
    return make_sampler(GetParam(), dimension, seed, bridge ? in_the_slot : beside_the_wall,
                        {0.1, 20000});
  }

  static Points points(const Sampler& sampler, int count) {
    Points points;
    for (int i = 0; i < count; ++i) {
      points.push_back(sampler.point(static_cast<std::uint64_t>(i)));
    }
    return points;
  }
};

TEST_P(EverySampler, ChoosesPointsOfTheUnitCube) {
  for (const int dimension : {1, 2, 6, 22}) {
    const auto sampler = make(dimension, 1);
    EXPECT_EQ(sampler->dimension(), dimension);
    for (const auto& point : points(*sampler, 200)) {
      ASSERT_EQ(point.size(), dimension);
      ASSERT_GE(point.minCoeff(), 0.0);
      ASSERT_LE(point.maxCoeff(), 1.0);
    }
  }
}

TEST_P(EverySampler, ChoosesAPointByItsIndexAlone) {
  const auto one = make(5, 9);
  const auto two = make(5, 9);
  const Points forwards = points(*one, 50);
  for (int i = 49; i >= 0; --i) {
    EXPECT_EQ(two->point(static_cast<std::uint64_t>(i)), forwards[static_cast<std::size_t>(i)]);
  }
}

TEST_P(EverySampler, ChoosesOtherPointsForAnotherSeed) {
  EXPECT_NE(points(*make(5, 9), 50), points(*make(5, 10), 50));
}

TEST_P(EverySampler, FillsTheCube) {
  const auto sampler = make(2, 3);
  const bool slot_only = GetParam() == SamplerKind::kBridgeTest;
  std::vector<int> per_quarter(4, 0);
  for (const auto& point : points(*sampler, 400)) {
    const int along_wall = point[1] < 0.5 ? 0 : 1;
    const int across_wall = !slot_only && point[0] < 0.5 ? 2 : 0;
    ++per_quarter[static_cast<std::size_t>(along_wall + across_wall)];
  }
  const int quarters = slot_only ? 2 : 4;
  for (int quarter = 0; quarter < quarters; ++quarter) {
    EXPECT_GT(per_quarter[static_cast<std::size_t>(quarter)], 280 / quarters);
  }
}

TEST_P(EverySampler, RefusesNoDimensions) { EXPECT_THROW(make(0, 1), std::invalid_argument); }

INSTANTIATE_TEST_SUITE_P(Kinds, EverySampler,
                         ::testing::Values(SamplerKind::kRandom, SamplerKind::kHalton,
                                           SamplerKind::kSdk, SamplerKind::kGaussian,
                                           SamplerKind::kBridgeTest),
                         [](const auto& kind) {
                           std::string name = sampler_names()[static_cast<std::size_t>(kind.param)];
                           std::erase(name, '-');
                           return name;
                         });

TEST(GaussianSampler, ChoosesValidPointsNearTheBorder) {
  constexpr double kSigma = 0.05;
  const auto sampler = make_sampler(SamplerKind::kGaussian, 2, 1, in_the_left_half, {kSigma, 1000});
  double mean_distance = 0.0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const auto point = sampler->point(i);
    ASSERT_TRUE(in_the_left_half(point));
    ASSERT_LT(0.5 - point[0], 6.0 * kSigma);
    mean_distance += (0.5 - point[0]) / 1000.0;
  }
  EXPECT_LT(mean_distance, kSigma);
}

TEST(GaussianSampler, ChoosesAnyPointWhereThereIsNoBorder) {
  int asked = 0;
  const auto sampler = make_sampler(SamplerKind::kGaussian, 2, 1,
                                    [&](const Eigen::VectorXd&) {
                                      ++asked;
                                      return true;
                                    },
                                    {0.1, 50});
  EXPECT_NE(sampler->point(0), sampler->point(1));
  EXPECT_LE(asked, 4 * 50);
}

TEST(BridgeTestSampler, ChoosesValidPointsOfTheNarrowPassage) {
  const auto sampler = make_sampler(SamplerKind::kBridgeTest, 3, 1, in_the_slot, {0.1, 10000});
  for (std::uint64_t i = 0; i < 500; ++i) {
    const auto point = sampler->point(i);
    ASSERT_TRUE(in_the_slot(point));
  }
}

TEST(BridgeTestSampler, ChoosesAnyPointOfAWideSpace) {
  const auto sampler = make_sampler(SamplerKind::kBridgeTest, 2, 1, in_the_left_half, {0.05, 500});
  EXPECT_NE(sampler->point(0), sampler->point(1));
}

TEST(SamplersOfPairs, RefuseOptionsOutOfRange) {
  for (const SamplerKind kind : {SamplerKind::kGaussian, SamplerKind::kBridgeTest}) {
    EXPECT_THROW(make_sampler(kind, 2, 1, in_the_slot, {0.0, 10}), std::invalid_argument);
    EXPECT_THROW(make_sampler(kind, 2, 1, in_the_slot, {NAN, 10}), std::invalid_argument);
    EXPECT_THROW(make_sampler(kind, 2, 1, in_the_slot, {0.1, 0}), std::invalid_argument);
    EXPECT_THROW(make_sampler(kind, 2, 1), std::invalid_argument);
  }
}

}  // namespace
}  // namespace handway::sampling
