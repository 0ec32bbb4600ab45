#include "handway/sampling/sequences/halton_sequence.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

namespace handway::sampling {
namespace {

TEST(VanDerCorput, MirrorsTheDigitsAtTheRadixPoint) {
  const std::vector<double> base_2 = {0, 0.5, 0.25, 0.75, 0.125, 0.625, 0.375, 0.875, 0.0625};
  for (std::size_t i = 0; i < base_2.size(); ++i) {
    EXPECT_EQ(van_der_corput(i), base_2[i]);
  }
  const std::vector<double> ninths = {0, 3, 6, 1, 4, 7, 2, 5, 8};
  for (std::size_t i = 0; i < ninths.size(); ++i) {
    EXPECT_NEAR(van_der_corput(i, 3), ninths[i] / 9.0, 1e-15);
  }
}

TEST(VanDerCorput, StaysBelowOne) {
  EXPECT_LT(van_der_corput(std::numeric_limits<std::uint64_t>::max()), 1.0);
  EXPECT_LT(van_der_corput(std::numeric_limits<std::uint64_t>::max(), 3), 1.0);
}

TEST(VanDerCorput, RefusesABaseBelowTwo) {
  EXPECT_THROW(static_cast<void>(van_der_corput(1, 1)), std::invalid_argument);
}

TEST(SweepPosition, FollowsThePaperOrder) {
  const std::vector<double> positions = {0, 1, 0.5, 0.25, 0.75, 0.125, 0.625};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    EXPECT_EQ(sweep_position(i), positions[i]);
  }
}

TEST(SweepPosition, VisitsEvenlySpacedPointsOnce) {
  for (const std::uint64_t steps : {1u, 2u, 16u, 1024u}) {
    std::set<double> visited;
    for (std::uint64_t i = 0; i <= steps; ++i) {
      visited.insert(sweep_position(i));
    }
    std::set<double> expected;
    for (std::uint64_t i = 0; i <= steps; ++i) {
      expected.insert(static_cast<double>(i) / static_cast<double>(steps));
    }
    EXPECT_EQ(visited, expected);
  }
}

}  // namespace
}  // namespace handway::sampling
