#include "handway/sampling/samplers/bridge_test_sampler.h"
#include "handway/sampling/samplers/gaussian_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace handway::sampling {
namespace {

bool in_the_left_half(const Eigen::VectorXd& point) { return point[0] < 0.5; }

bool in_the_narrow_slot(const Eigen::VectorXd& point) { return std::abs(point[0] - 0.5) < 0.02; }

TEST(GaussianSampler, DrawsValidPointsNearTheBorder) {
  constexpr double kSigma = 0.05;
  GaussianSampler sampler(2, 1, in_the_left_half, {kSigma, 1000});
  double mean_distance = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const auto point = sampler.draw();
    ASSERT_TRUE(point.has_value());
    ASSERT_TRUE(in_the_left_half(*point));
    ASSERT_LT(0.5 - (*point)[0], 6.0 * kSigma);
    mean_distance += (0.5 - (*point)[0]) / 1000.0;
  }
  EXPECT_LT(mean_distance, kSigma);
}

TEST(GaussianSampler, GivesUpWhereThereIsNoBorder) {
  int asked = 0;
  GaussianSampler sampler(2, 1,
                          [&](const Eigen::VectorXd&) {
                            ++asked;
                            return true;
                          },
                          {0.1, 50});
  EXPECT_EQ(sampler.draw(), std::nullopt);
  EXPECT_LE(asked, 2 * 50);
}

TEST(BridgeTestSampler, DrawsValidPointsOfTheNarrowPassage) {
  BridgeTestSampler sampler(3, 1, in_the_narrow_slot, {0.1, 10000});
  for (int i = 0; i < 500; ++i) {
    const auto point = sampler.draw();
    ASSERT_TRUE(point.has_value());
    ASSERT_TRUE(in_the_narrow_slot(*point));
  }
}

TEST(BridgeTestSampler, FindsNothingInAWideSpace) {
  BridgeTestSampler sampler(2, 1, in_the_left_half, {0.05, 500});
  EXPECT_EQ(sampler.draw(), std::nullopt);
}

TEST(ValiditySamplers, RefuseOptionsOutOfRange) {
  EXPECT_THROW(GaussianSampler(2, 1, in_the_narrow_slot, {0.0, 10}), std::invalid_argument);
  EXPECT_THROW(GaussianSampler(2, 1, in_the_narrow_slot, {0.1, 0}), std::invalid_argument);
  EXPECT_THROW(GaussianSampler(2, 1, nullptr), std::invalid_argument);
  EXPECT_THROW(BridgeTestSampler(2, 1, in_the_narrow_slot, {NAN, 10}), std::invalid_argument);
  EXPECT_THROW(BridgeTestSampler(2, 1, in_the_narrow_slot, {0.1, 0}), std::invalid_argument);
  EXPECT_THROW(BridgeTestSampler(2, 1, nullptr), std::invalid_argument);
}

}  // namespace
}  // namespace handway::sampling
