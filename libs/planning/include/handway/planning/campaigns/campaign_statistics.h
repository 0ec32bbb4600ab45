#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/export.h"
#include "handway/sampling/postures/quantile.h"

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace handway::planning {

/// An interval of numbers.
struct Interval {
  double lower = 0.0;
  double upper = 0.0;
};

/// Mean of values without NaN; infinite ones (runs that never found a path) sort last.
[[nodiscard]] HANDWAY_PLANNING_EXPORT double mean_of(std::span<const double> values);

/// Standard deviation with n - 1 in the denominator; NaN for fewer than two.
[[nodiscard]] HANDWAY_PLANNING_EXPORT double deviation_of(std::span<const double> values);

using sampling::quantile_of;

/// Interval of the mean by the percentile bootstrap with a fixed seed (B. Efron, R. J. Tibshirani,
/// "An Introduction to the Bootstrap", 1993, chapter 13). It lies within the values, so that times
/// and counts never get a negative bound. NaN for fewer than two values.
/// @param confidence in (0, 1).
[[nodiscard]] HANDWAY_PLANNING_EXPORT Interval mean_interval(std::span<const double> values,
                                                             double confidence = 0.95);

/// Interval of the probability of success after `successes` in `trials` (E. B. Wilson, "Probable
/// inference, the law of succession, and statistical inference", JASA 22, 1927; without correction
/// for continuity). [0, 1] without trials.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Interval wilson_interval(std::size_t successes,
                                                               std::size_t trials,
                                                               double confidence = 0.95);

/// A step of an empirical distribution function: this share of all values is ≤ value.
struct EcdfStep {
  double value = 0.0;
  double share = 0.0;
};

/// One step for each different finite value; infinite ones count too, so that the last share is
/// below 1 if there are any.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<EcdfStep> ecdf_of(std::span<const double> values);

/// Values of a box plot (J. W. Tukey, "Exploratory Data Analysis", 1977): quartiles, whiskers at
/// the last values within 1.5 box lengths, and the outliers beyond.
struct BoxPlot {
  double lower_whisker = 0.0;
  double lower_quartile = 0.0;
  double median = 0.0;
  double upper_quartile = 0.0;
  double upper_whisker = 0.0;
  std::vector<double> outliers;  ///< In order.
};

/// @pre values is not empty and all are finite.
[[nodiscard]] HANDWAY_PLANNING_EXPORT BoxPlot box_plot_of(std::span<const double> values);

/// Outcome of a Mann-Whitney U test.
struct MannWhitney {
  double u = 0.0;       ///< Pairs in which the first sample's value is larger; ties half.
  double effect = 0.5;  ///< Probability that the first is smaller, ties half: 1 - u/(n m).
  double p = 1.0;       ///< Two-sided.
  bool exact = false;   ///< p from U's exact distribution, not from the normal approximation.
};

/// Tests whether the values of two samples tend to differ (H. B. Mann and D. R. Whitney, "On a test
/// of whether one of two random variables is stochastically larger than the other", Annals of
/// Mathematical Statistics 18, 1947). Exact for samples of fewer than 50 without ties; else the
/// normal approximation with corrections for ties and continuity, as in R's wilcox.test. Values may
/// be infinite, not NaN; p is 1 if a sample is empty or all values are the same.
[[nodiscard]] HANDWAY_PLANNING_EXPORT MannWhitney mann_whitney(std::span<const double> first,
                                                               std::span<const double> second);

/// p-values of several tests, adjusted so that the probability of one false finding among all stays
/// below that of each (S. Holm, "A simple sequentially rejective multiple test procedure",
/// Scandinavian Journal of Statistics 6, 1979). In the order of `p`.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<double> holm_adjusted(std::span<const double> p);

/// A number of a run in reports.
struct RunMeasure {
  std::string key;    ///< In files, for example "time_s".
  std::string label;  ///< Display name, with its unit.
  std::function<double(const RunRecord&)> value;
};

/// Measures of every report, planning time first.
[[nodiscard]] HANDWAY_PLANNING_EXPORT const std::vector<RunMeasure>& run_measures();

/// The runs of a planner on a problem.
struct CampaignCell {
  int problem = 0;
  int planner = 0;
  std::vector<RunRecord> runs;

  [[nodiscard]] HANDWAY_PLANNING_EXPORT std::size_t solved() const;
  /// Values of the runs that found a path.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<double> of_solved(
      const RunMeasure& measure) const;
  /// Planning times of all runs, s; infinite for those without a path.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<double> times() const;
};

/// Two planners' planning times on one problem.
struct CampaignComparison {
  int problem = 0;
  int first = 0;   ///< Planner.
  int second = 0;  ///< Planner.
  MannWhitney test;
  double adjusted_p = 1.0;  ///< Holm, over all comparisons on the problem.
};

/// Returns a cell for each problem and planner, problem by problem, also for those without runs.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<CampaignCell> campaign_cells(
    const Campaign& campaign, std::span<const RunRecord> records);

/// Compares all pairs of planners that have runs, problem by problem. A run without a path counts
/// as longer than all with one.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<CampaignComparison> compare_planners(
    std::span<const CampaignCell> cells);

}  // namespace handway::planning
