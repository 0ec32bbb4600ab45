#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace handway::sampling {

/// The value below which that share of the values lies. @pre there is a value.
[[nodiscard]] inline double quantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + at);
  return values[static_cast<std::size_t>(at)];
}

}  // namespace handway::sampling
