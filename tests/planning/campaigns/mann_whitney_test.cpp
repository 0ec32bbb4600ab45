/// The Mann-Whitney test against published values.
#include "handway/planning/campaigns/campaign_statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace handway::planning {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

// M. Hollander and D. A. Wolfe, "Nonparametric Statistical Methods", 1973, p. 69:
// permeability of the human chorioamnion. W = 35, one-sided p = 0.1272 (R: ?wilcox.test).
TEST(MannWhitney, AgreesWithHollanderAndWolfe) {
  const std::vector<double> at_term = {0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46};
  const std::vector<double> early = {1.15, 0.88, 0.90, 0.74, 1.21};
  const MannWhitney test = mann_whitney(at_term, early);
  EXPECT_TRUE(test.exact);
  EXPECT_DOUBLE_EQ(test.u, 35.0);
  EXPECT_NEAR(test.p, 2.0 * 0.1272, 1e-4);
  EXPECT_DOUBLE_EQ(test.effect, 0.3);
  const MannWhitney other_way = mann_whitney(early, at_term);
  EXPECT_DOUBLE_EQ(other_way.u, 15.0);
  EXPECT_DOUBLE_EQ(other_way.p, test.p);
}

// R: wilcox.test(Ozone ~ Month, data = airquality, subset = Month %in% c(5, 8)) in its
// documentation: W = 127.5, p = 0.0001208, with ties.
TEST(MannWhitney, AgreesWithROnTies) {
  const std::vector<double> may = {41, 36, 12, 18, 28, 23, 19, 8, 7,  16, 11, 14,  18,
                                   14, 34, 6,  30, 11, 1,  11, 4, 32, 23, 45, 115, 37};
  const std::vector<double> august = {39, 9,  16, 78, 35, 66, 122, 89,  110, 44, 28,  65, 22,
                                      59, 23, 31, 44, 21, 9,  45,  168, 73,  76, 118, 84, 85};
  const MannWhitney test = mann_whitney(may, august);
  EXPECT_FALSE(test.exact);
  EXPECT_DOUBLE_EQ(test.u, 127.5);
  EXPECT_NEAR(test.p, 0.0001208, 5e-8);
}

// H. B. Mann and D. R. Whitney, 1947, table I: n = 4, m = 4, P(U ≤ 1) = 0.029.
TEST(MannWhitney, HasTheExactDistributionOfSmallSamples) {
  const MannWhitney test =
      mann_whitney(std::vector{1.0, 2.0, 3.0, 5.0}, std::vector{4.0, 6.0, 7.0, 8.0});
  EXPECT_DOUBLE_EQ(test.u, 1.0);
  EXPECT_NEAR(test.p, 2.0 * 2.0 / 70.0, 1e-12);
}

TEST(MannWhitney, TakesRunsWithoutAPathForTheSlowest) {
  constexpr double kNoPath = std::numeric_limits<double>::infinity();
  const MannWhitney test =
      mann_whitney(std::vector{1.0, 2.0, 3.0}, std::vector{4.0, kNoPath, kNoPath});
  EXPECT_DOUBLE_EQ(test.effect, 1.0);
  EXPECT_LT(test.p, 0.1);
}

TEST(MannWhitney, FindsNothingWhereThereIsNothing) {
  EXPECT_EQ(mann_whitney({}, std::vector{1.0}).p, 1.0);
  EXPECT_EQ(mann_whitney(std::vector{1.0, 1.0}, std::vector{1.0, 1.0, 1.0}).p, 1.0);
}

// R: p.adjust(c(0.01, 0.04, 0.03, 0.005), "holm").
TEST(HolmAdjustment, AgreesWithR) {
  EXPECT_THAT(holm_adjusted(std::vector{0.01, 0.04, 0.03, 0.005}),
              ElementsAre(DoubleNear(0.03, 1e-12), DoubleNear(0.06, 1e-12), DoubleNear(0.06, 1e-12),
                          DoubleNear(0.02, 1e-12)));
}

}  // namespace
}  // namespace handway::planning
