#include "handway/planning/campaigns/campaign_statistics.h"

#include "handway/geometric/math/units.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Core>
#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace handway::planning {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> sorted(std::span<const double> values) {
  std::vector<double> result(values.begin(), values.end());
  std::sort(result.begin(), result.end());
  return result;
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
  const Eigen::Map<const Eigen::ArrayXd> x(values.data(), std::ssize(values));
  return std::sqrt((x - mean_of(values)).square().sum() / static_cast<double>(values.size() - 1));
}

Interval mean_interval(std::span<const double> values, double confidence) {
  if (values.size() < 2) {
    return {kNan, kNan};
  }
  constexpr int kResamples = 2000;
  sampling::RandomStream random(1);
  std::vector<double> means(kResamples);
  for (double& mean : means) {
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum += values[random.below(values.size())];
    }
    mean = sum / static_cast<double>(values.size());
  }
  return {quantile_of(means, 0.5 - confidence / 2.0), quantile_of(means, 0.5 + confidence / 2.0)};
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
  // At the ends the bound is 0 or 1 up to rounding.
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
  box.lower_quartile = quantile_of(order, 0.25);
  box.median = quantile_of(order, 0.5);
  box.upper_quartile = quantile_of(order, 0.75);
  const double reach = kReach * (box.upper_quartile - box.lower_quartile);
  const auto first = std::ranges::lower_bound(order, box.lower_quartile - reach);
  const auto last = std::ranges::upper_bound(order, box.upper_quartile + reach);
  box.lower_whisker = *first;
  box.upper_whisker = *std::prev(last);
  box.outliers.assign(order.begin(), first);
  box.outliers.insert(box.outliers.end(), last, order.end());
  return box;
}

namespace {

// Pairs in which a value of the first sample is the larger; ties half.
double count_larger(std::span<const double> first, std::span<const double> second) {
  const std::vector<double> others = sorted(second);
  double larger = 0.0;
  for (const double value : first) {
    const auto lower = std::ranges::lower_bound(others, value);
    const auto upper = std::upper_bound(lower, others.end(), value);
    larger += 0.5 * static_cast<double>((lower - others.begin()) + (upper - others.begin()));
  }
  return larger;
}

// Σ (t³ - t) over groups of t equal values.
double tie_term(std::vector<double> values) {
  std::ranges::sort(values);
  double term = 0.0;
  for (auto begin = values.begin(); begin != values.end();) {
    const auto end = std::upper_bound(begin, values.end(), *begin);
    const auto t = static_cast<double>(end - begin);
    term += t * t * t - t;
    begin = end;
  }
  return term;
}

// P(U ≤ u) for samples of n and m without ties, by Mann and Whitney's recurrence over the
// number of arrangements with each U, built up as the product of Gaussian binomials.
double exact_cumulative(std::size_t n, std::size_t m, std::size_t u) {
  std::vector<double> counts(n * m + 1, 0.0);
  counts[0] = 1.0;
  for (std::size_t i = 1; i <= n; ++i) {  // times (1 - q^(m+i)) / (1 - q^i)
    for (std::size_t k = counts.size(); k-- > m + i;) {
      counts[k] -= counts[k - m - i];
    }
    for (std::size_t k = i; k < counts.size(); ++k) {
      counts[k] += counts[k - i];
    }
  }
  const double all = std::accumulate(counts.begin(), counts.end(), 0.0);
  return std::accumulate(counts.begin(), counts.begin() + static_cast<std::ptrdiff_t>(u) + 1, 0.0) /
         all;
}

}  // namespace

MannWhitney mann_whitney(std::span<const double> first, std::span<const double> second) {
  constexpr std::size_t kFewest = 50;  // values of a sample for the normal approximation
  const auto n = static_cast<double>(first.size());
  const auto m = static_cast<double>(second.size());
  MannWhitney result;
  if (first.empty() || second.empty()) {
    return result;
  }
  std::vector<double> all(first.begin(), first.end());
  all.insert(all.end(), second.begin(), second.end());
  const double ties = tie_term(std::move(all));
  result.u = count_larger(first, second);
  result.effect = 1.0 - result.u / (n * m);
  if (ties == 0.0 && first.size() < kFewest && second.size() < kFewest) {
    const double smaller = std::min(result.u, n * m - result.u);
    result.exact = true;
    result.p = std::min(1.0, 2.0 * exact_cumulative(first.size(), second.size(),
                                                    static_cast<std::size_t>(smaller)));
    return result;
  }
  const double total = n + m;
  const double variance = n * m / 12.0 * (total + 1.0 - ties / (total * (total - 1.0)));
  if (variance <= 0.0) {
    return result;
  }
  const double distance = std::max(std::abs(result.u - n * m / 2.0) - 0.5, 0.0);
  const boost::math::normal normal;
  result.p = std::min(
      1.0, 2.0 * boost::math::cdf(boost::math::complement(normal, distance / std::sqrt(variance))));
  return result;
}

std::vector<double> holm_adjusted(std::span<const double> p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p[i]; });
  std::vector<double> adjusted(p.size());
  double most = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    most = std::max(most, std::min(1.0, p[order[i]] * static_cast<double>(p.size() - i)));
    adjusted[order[i]] = most;
  }
  return adjusted;
}

const std::vector<RunMeasure>& run_measures() {
  const auto field = [](auto member) {
    return [member](const RunRecord& run) { return static_cast<double>(run.*member); };
  };
  static const std::vector<RunMeasure> kMeasures = {
      {"time_s", "Time to find a solution [s]", field(&RunRecord::time_s)},
      {"smoothing_s", "Smoothing time [s]", field(&RunRecord::smoothing_s)},
      {"samples", "Samples", field(&RunRecord::samples)},
      {"nodes", "Nodes of the roadmap or trees", field(&RunRecord::nodes)},
      {"checks", "Configurations checked",
       [](const RunRecord& run) { return static_cast<double>(run.checks()); }},
      {"path_nodes", "Nodes in the solution path", field(&RunRecord::path_nodes)},
      {"path_length", "Length of the path (normalised joints)", field(&RunRecord::path_length)},
      {"min_clearance_mm", "Smallest clearance [mm]",
       [](const RunRecord& run) { return geometric::millimetres(run.min_clearance); }},
      {"cpu_s", "Processor time of the run [s]", field(&RunRecord::cpu_s)},
      {"l2_length", "Length of the path (rad, m)", field(&RunRecord::l2_length)},
      {"to_subspace", "Mean distance of the hand from the PMD subspace",
       [](const RunRecord& run) { return run.measures.to_subspace; }},
      {"hand_sparc", "Spectral arc length of the hand's speed",
       [](const RunRecord& run) { return run.measures.hand_sparc; }},
      {"palm_sparc", "Spectral arc length of the palm's speed",
       [](const RunRecord& run) { return run.measures.palm_sparc; }},
      {"arm_deviation", "Deviation of the arm from its straight motion",
       [](const RunRecord& run) { return run.measures.arm_deviation; }},
  };
  return kMeasures;
}

std::size_t CampaignCell::solved() const {
  return static_cast<std::size_t>(std::ranges::count_if(runs, &RunRecord::solved));
}

std::vector<double> CampaignCell::of_solved(const RunMeasure& measure) const {
  std::vector<double> values;
  for (const RunRecord& run : runs) {
    if (const double value = measure.value(run); run.solved && !std::isnan(value)) {
      values.push_back(value);
    }
  }
  return values;
}

std::vector<double> CampaignCell::times() const {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const RunRecord& run : runs) {
    values.push_back(run.solved ? run.time_s : std::numeric_limits<double>::infinity());
  }
  return values;
}

std::vector<CampaignCell> campaign_cells(const Campaign& campaign,
                                         std::span<const RunRecord> records) {
  std::vector<CampaignCell> cells;
  for (int problem = 0; problem < static_cast<int>(campaign.problems.size()); ++problem) {
    for (int planner = 0; planner < static_cast<int>(campaign.planners.size()); ++planner) {
      cells.push_back({problem, planner, {}});
    }
  }
  for (const RunRecord& record : records) {
    const std::size_t cell =
        static_cast<std::size_t>(record.spec.problem) * campaign.planners.size() +
        static_cast<std::size_t>(record.spec.planner);
    cells[cell].runs.push_back(record);
  }
  return cells;
}

std::vector<CampaignComparison> compare_planners(std::span<const CampaignCell> cells) {
  std::vector<CampaignComparison> all;
  for (std::size_t begin = 0, end = 0; begin < cells.size(); begin = end) {
    while (end < cells.size() && cells[end].problem == cells[begin].problem) {
      ++end;
    }
    const std::size_t compared = all.size();
    std::vector<double> p;
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = i + 1; j < end; ++j) {
        if (!cells[i].runs.empty() && !cells[j].runs.empty()) {
          all.push_back({cells[i].problem, cells[i].planner, cells[j].planner,
                         mann_whitney(cells[i].times(), cells[j].times()), 1.0});
          p.push_back(all.back().test.p);
        }
      }
    }
    const std::vector<double> adjusted = holm_adjusted(p);
    for (std::size_t i = 0; i < adjusted.size(); ++i) {
      all[compared + i].adjusted_p = adjusted[i];
    }
  }
  return all;
}

}  // namespace handway::planning
