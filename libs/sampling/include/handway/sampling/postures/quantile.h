#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace handway::sampling {

/// The p-quantile, 0 ≤ p ≤ 1, by linear interpolation between order statistics (type 7 of Hyndman
/// and Fan, "Sample quantiles in statistical packages", The American Statistician 50, 1996).
/// Infinite if it depends on an infinite value; NaN without values.
[[nodiscard]] inline double quantile_of(std::vector<double> values, double p) {
  if (values.empty()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const double at = p * static_cast<double>(values.size() - 1);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(at);
  const double rest = at - static_cast<double>(below - values.begin());
  std::nth_element(values.begin(), below, values.end());
  const double above = rest > 0.0 ? *std::min_element(below + 1, values.end()) : *below;
  return above == *below ? above : *below + rest * (above - *below);  // equal: infinite ones too
}

}  // namespace handway::sampling
