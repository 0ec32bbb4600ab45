#include "handway/geometric/math/sine_cosine.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace handway::geometric {
namespace {

struct SinesCosines {
  std::vector<double> sines, cosines;
};

SinesCosines of(const std::vector<double>& angles) {
  SinesCosines result{std::vector<double>(angles.size()), std::vector<double>(angles.size())};
  sine_cosine(angles.data(), angles.size(), result.sines.data(), result.cosines.data());
  return result;
}

void expect_close(const std::vector<double>& angles) {
  const SinesCosines result = of(angles);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const auto exact = static_cast<long double>(angles[i]);
    ASSERT_LT(std::abs(static_cast<double>(result.sines[i] - std::sin(exact))), 2.3e-16)
        << angles[i];
    ASSERT_LT(std::abs(static_cast<double>(result.cosines[i] - std::cos(exact))), 2.3e-16)
        << angles[i];
  }
}

TEST(SineCosine, IsRightToTheLastPlacesInAndBeyondJointRanges) {
  std::mt19937_64 engine(1);
  for (const double range : {1e-3, 1.0, 7.0, 1000.0, kLargestFastAngle}) {
    std::uniform_real_distribution<double> uniform(-range, range);
    std::vector<double> angles(20000);
    for (double& angle : angles) {
      angle = uniform(engine);
    }
    expect_close(angles);
  }
}

TEST(SineCosine, IsRightAroundMultiplesOfAnEighthTurn) {
  std::vector<double> angles;
  for (int k = -64; k <= 64; ++k) {
    for (const double offset : {-1e-9, 0.0, 1e-9}) {
      angles.push_back(k * std::numbers::pi / 4 + offset);
    }
  }
  expect_close(angles);
}

TEST(SineCosine, HandsHugeAndMissingAnglesToTheCLibrary) {
  const SinesCosines result = of({0.5, 1e9, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_DOUBLE_EQ(result.sines[0], std::sin(0.5));
  EXPECT_DOUBLE_EQ(result.cosines[1], std::cos(1e9));
  EXPECT_TRUE(std::isnan(result.sines[2]));
}

TEST(SineCosine, DoesNotDependOnTheCompany) {
  const std::vector<double> angles = {0.1, -2.0, 3.0, 1.7, -0.4, 5.5, 0.9};
  const SinesCosines together = of(angles);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const SinesCosines alone = of({angles[i]});
    EXPECT_EQ(alone.sines[0], together.sines[i]);
    EXPECT_EQ(alone.cosines[0], together.cosines[i]);
  }
}

}  // namespace
}  // namespace handway::geometric
