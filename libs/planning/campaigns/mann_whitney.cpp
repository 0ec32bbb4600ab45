#include "handway/planning/campaigns/mann_whitney.h"

#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace handway::planning {
namespace {

struct Ranks {
  double first_sum = 0.0;  ///< Of the first sample's ranks, ties by their mean rank.
  double ties = 0.0;       ///< Σ (t³ - t) over groups of t equal values.
};

Ranks rank(std::span<const double> first, std::span<const double> second) {
  std::vector<std::pair<double, bool>> all;  // value, is of the first sample
  all.reserve(first.size() + second.size());
  for (const double value : first) {
    all.emplace_back(value, true);
  }
  for (const double value : second) {
    all.emplace_back(value, false);
  }
  std::ranges::sort(all, {}, &std::pair<double, bool>::first);
  Ranks ranks;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    while (end < all.size() && all[end].first == all[begin].first) {
      ++end;
    }
    const double mean_rank = static_cast<double>(begin + 1 + end) / 2.0;
    const auto t = static_cast<double>(end - begin);
    ranks.ties += t * t * t - t;
    for (std::size_t i = begin; i < end; ++i) {
      ranks.first_sum += all[i].second ? mean_rank : 0.0;
    }
  }
  return ranks;
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
  const Ranks ranks = rank(first, second);
  result.u = ranks.first_sum - n * (n + 1.0) / 2.0;
  result.effect = 1.0 - result.u / (n * m);
  if (ranks.ties == 0.0 && first.size() < kFewest && second.size() < kFewest) {
    const double smaller = std::min(result.u, n * m - result.u);
    result.exact = true;
    result.p = std::min(1.0, 2.0 * exact_cumulative(first.size(), second.size(),
                                                    static_cast<std::size_t>(smaller)));
    return result;
  }
  const double total = n + m;
  const double variance = n * m / 12.0 * (total + 1.0 - ranks.ties / (total * (total - 1.0)));
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

}  // namespace handway::planning
