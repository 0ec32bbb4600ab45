#pragma once

#include "handway/planning/export.h"

#include <cstddef>
#include <span>
#include <vector>

namespace handway::planning {

struct Interval {
  double lower = 0.0;
  double upper = 0.0;
};

/// Of values without NaN; infinite ones (runs that never found a path) sort last.
[[nodiscard]] HANDWAY_PLANNING_EXPORT double mean_of(std::span<const double> values);

/// With n - 1 in the denominator; NaN for fewer than two.
[[nodiscard]] HANDWAY_PLANNING_EXPORT double deviation_of(std::span<const double> values);

/// The p-quantile, 0 ≤ p ≤ 1, by linear interpolation between order statistics (type 7 of
/// Hyndman and Fan, "Sample quantiles in statistical packages", The American
/// Statistician 50, 1996). Infinite once a value that it leans on is; NaN without values.
[[nodiscard]] HANDWAY_PLANNING_EXPORT double quantile_of(std::span<const double> values, double p);

/// Of the mean, by Student's t distribution. NaN for fewer than two values.
/// @param confidence in (0, 1).
[[nodiscard]] HANDWAY_PLANNING_EXPORT Interval mean_interval(std::span<const double> values,
                                                             double confidence = 0.95);

/// Of the chance of success after `successes` in `trials` (E. B. Wilson, "Probable
/// inference, the law of succession, and statistical inference", JASA 22, 1927; without
/// correction for continuity). [0, 1] without trials.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Interval wilson_interval(std::size_t successes,
                                                               std::size_t trials,
                                                               double confidence = 0.95);

/// A step of an empirical distribution function: this share of all values is ≤ value.
struct EcdfStep {
  double value = 0.0;
  double share = 0.0;
};

/// One step for each different finite value; infinite ones count among all, so that the
/// last share is below 1 if there are some.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<EcdfStep> ecdf_of(std::span<const double> values);

/// What a box plot draws (J. W. Tukey, "Exploratory Data Analysis", 1977): quartiles,
/// whiskers at the last values within 1.5 box lengths, and the outliers beyond.
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

}  // namespace handway::planning
