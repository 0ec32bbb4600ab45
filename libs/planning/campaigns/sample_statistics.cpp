#include "handway/planning/campaigns/sample_statistics.h"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace handway::planning {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> sorted(std::span<const double> values) {
  std::vector<double> result(values.begin(), values.end());
  std::sort(result.begin(), result.end());
  return result;
}

double quantile_of_sorted(const std::vector<double>& values, double p) {
  if (values.empty()) {
    return kNan;
  }
  const double at = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const double rest = at - static_cast<double>(below);
  if (rest == 0.0 || values[below] == values[below + 1]) {  // equal: infinite ones too
    return values[below];
  }
  return values[below] + rest * (values[below + 1] - values[below]);
}

}  // namespace

double mean_of(std::span<const double> values) {
  return values.empty() ? kNan
                        : std::accumulate(values.begin(), values.end(), 0.0) /
                              static_cast<double>(values.size());
}

double deviation_of(std::span<const double> values) {
  if (values.size() < 2) {
    return kNan;
  }
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - mean) * (value - mean);
  }
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double quantile_of(std::span<const double> values, double p) {
  return quantile_of_sorted(sorted(values), p);
}

Interval mean_interval(std::span<const double> values, double confidence) {
  if (values.size() < 2) {
    return {kNan, kNan};
  }
  const auto n = static_cast<double>(values.size());
  const boost::math::students_t t(n - 1.0);
  const double half =
      boost::math::quantile(t, 0.5 + confidence / 2.0) * deviation_of(values) / std::sqrt(n);
  const double mean = mean_of(values);
  return {mean - half, mean + half};
}

Interval wilson_interval(std::size_t successes, std::size_t trials, double confidence) {
  if (trials == 0) {
    return {0.0, 1.0};
  }
  const double z = boost::math::quantile(boost::math::normal(), 0.5 + confidence / 2.0);
  const auto n = static_cast<double>(trials);
  const double p = static_cast<double>(successes) / n;
  const double denominator = 1.0 + z * z / n;
  const double centre = (p + z * z / (2.0 * n)) / denominator;
  const double half = z / denominator * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  // At the ends the bound is 0 or 1 but for rounding.
  return {successes == 0 ? 0.0 : centre - half, successes == trials ? 1.0 : centre + half};
}

std::vector<EcdfStep> ecdf_of(std::span<const double> values) {
  const std::vector<double> order = sorted(values);
  std::vector<EcdfStep> steps;
  for (std::size_t i = 0; i < order.size() && std::isfinite(order[i]); ++i) {
    const double share = static_cast<double>(i + 1) / static_cast<double>(order.size());
    if (!steps.empty() && steps.back().value == order[i]) {
      steps.back().share = share;
    } else {
      steps.push_back({order[i], share});
    }
  }
  return steps;
}

BoxPlot box_plot_of(std::span<const double> values) {
  constexpr double kReach = 1.5;  // box lengths
  const std::vector<double> order = sorted(values);
  BoxPlot box;
  box.lower_quartile = quantile_of_sorted(order, 0.25);
  box.median = quantile_of_sorted(order, 0.5);
  box.upper_quartile = quantile_of_sorted(order, 0.75);
  const double reach = kReach * (box.upper_quartile - box.lower_quartile);
  const auto first = std::ranges::lower_bound(order, box.lower_quartile - reach);
  const auto last = std::ranges::upper_bound(order, box.upper_quartile + reach);
  box.lower_whisker = *first;
  box.upper_whisker = *std::prev(last);
  box.outliers.assign(order.begin(), first);
  box.outliers.insert(box.outliers.end(), last, order.end());
  return box;
}

}  // namespace handway::planning
