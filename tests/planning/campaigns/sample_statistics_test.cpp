/// Means, quantiles and intervals against published values.
#include "handway/planning/campaigns/campaign_statistics.h"
#include "handway/sampling/sequences/random_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace handway::planning {
namespace {

using testing::ElementsAre;

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(Quantile, InterpolatesBetweenOrderStatistics) {
  const std::vector<double> values = {4.0, 1.0, 3.0, 2.0};
  EXPECT_DOUBLE_EQ(quantile_of(values, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile_of(values, 0.25), 1.75);  // R: quantile(1:4, 0.25)
  EXPECT_DOUBLE_EQ(quantile_of(values, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile_of(values, 1.0), 4.0);
  EXPECT_TRUE(std::isnan(quantile_of({}, 0.5)));
}

TEST(Quantile, IsInfiniteOnlyWhereRunsWithoutAPathDecide) {
  const std::vector<double> values = {1.0, kInf, 2.0, 3.0};
  EXPECT_DOUBLE_EQ(quantile_of(values, 0.5), 2.5);
  EXPECT_EQ(quantile_of(values, 0.9), kInf);
  EXPECT_EQ(quantile_of(std::vector{1.0, kInf, kInf, kInf}, 0.5), kInf);
}

// NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.5.2, data set ZARR13: n = 195,
// mean 9.261460, deviation 0.022789, 95 % interval 9.258242 to 9.264679. Two values of the
// same mean and deviation, in the same proportions, stand for the measurements.
TEST(MeanInterval, AgreesWithTheHandbook) {
  constexpr int kCount = 195;
  constexpr double kMean = 9.261460;
  constexpr double kDeviation = 0.022789;
  std::vector<double> values(1, kMean);
  const double half = kDeviation * std::sqrt((kCount - 1.0) / (kCount - 1.0));
  for (int i = 0; i < kCount / 2; ++i) {
    values.push_back(kMean - half);
    values.push_back(kMean + half);
  }
  ASSERT_EQ(values.size(), kCount);
  EXPECT_NEAR(deviation_of(values), kDeviation, 1e-6);
  const Interval interval = mean_interval(values);
  // NIST's interval by Student's t, 6.4e-3 wide; the bootstrap's bounds are random themselves.
  EXPECT_NEAR(interval.lower, 9.258242, 2e-4);
  EXPECT_NEAR(interval.upper, 9.264679, 2e-4);
}

TEST(MeanInterval, IsAmongTheValues) {
  const Interval interval = mean_interval(std::vector{0.1, 0.2, 0.1, 9.0});
  EXPECT_GE(interval.lower, 0.1);
  EXPECT_LE(interval.upper, 9.0);
}

TEST(MeanInterval, ContainsTheMeanOfAnExponentialDistributionAboutAsOftenAsItClaims) {
  constexpr int kSets = 300;
  sampling::RandomStream random(5);
  int contained = 0;
  for (int set = 0; set < kSets; ++set) {
    std::vector<double> values(50);
    std::ranges::generate(values, [&] { return -std::log(1.0 - random.uniform()); });
    const Interval interval = mean_interval(values);
    contained += interval.lower <= 1.0 && 1.0 <= interval.upper ? 1 : 0;
  }
  EXPECT_GE(contained, 0.89 * kSets);
  EXPECT_LE(contained, 0.98 * kSets);
}

TEST(MeanInterval, NeedsTwoValues) {
  EXPECT_TRUE(std::isnan(mean_interval(std::vector{1.0}).lower));
  EXPECT_TRUE(std::isnan(mean_of({})));
}

// R. G. Newcombe, "Two-sided confidence intervals for the single proportion: comparison of
// seven methods", Statistics in Medicine 17, 1998, table I, method 3.
TEST(WilsonInterval, AgreesWithNewcombesTable) {
  struct Row {
    std::size_t successes, trials;
    double lower, upper;
  };
  for (const Row& row : {Row{81, 263, 0.2553, 0.3662}, Row{15, 148, 0.0624, 0.1605},
                         Row{0, 20, 0.0, 0.1611}, Row{1, 29, 0.0061, 0.1718}}) {
    const Interval interval = wilson_interval(row.successes, row.trials);
    EXPECT_NEAR(interval.lower, row.lower, 5e-5);
    EXPECT_NEAR(interval.upper, row.upper, 5e-5);
  }
}

TEST(WilsonInterval, StaysWithinZeroAndOne) {
  EXPECT_EQ(wilson_interval(0, 7).lower, 0.0);
  EXPECT_EQ(wilson_interval(7, 7).upper, 1.0);
  EXPECT_EQ(wilson_interval(0, 0).upper, 1.0);
}

TEST(Ecdf, CountsInfiniteValuesAmongAll) {
  const std::vector<EcdfStep> steps = ecdf_of(std::vector{2.0, 1.0, kInf, 2.0});
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].value, 1.0);
  EXPECT_EQ(steps[0].share, 0.25);
  EXPECT_EQ(steps[1].value, 2.0);
  EXPECT_EQ(steps[1].share, 0.75);
}

// Michelson's measurements of the speed of light, first experiment (R: morley): R's
// boxplot.stats with quartiles of type 7 gives these.
TEST(BoxPlot, FindsWhiskersAndOutliers) {
  const std::vector<double> speeds = {850,  740, 900, 1070, 930, 850, 950,  980,  980, 880,
                                      1000, 980, 930, 650,  760, 810, 1000, 1000, 960, 960};
  const BoxPlot box = box_plot_of(speeds);
  EXPECT_DOUBLE_EQ(box.lower_quartile, 850.0);
  EXPECT_DOUBLE_EQ(box.median, 940.0);
  EXPECT_DOUBLE_EQ(box.upper_quartile, 980.0);
  EXPECT_DOUBLE_EQ(box.lower_whisker, 740.0);
  EXPECT_DOUBLE_EQ(box.upper_whisker, 1070.0);
  EXPECT_THAT(box.outliers, ElementsAre(650.0));
}

}  // namespace
}  // namespace handway::planning
