#pragma once

#include "handway/planning/export.h"

#include <span>
#include <vector>

namespace handway::planning {

/// Outcome of a Mann-Whitney U test.
struct MannWhitney {
  double u = 0.0;       ///< Pairs in which a value of the first sample is the larger; ties half.
  double effect = 0.5;  ///< Chance that the first's value is the smaller, ties half: 1 - u/(n m).
  double p = 1.0;       ///< Two-sided.
  bool exact = false;   ///< p from U's exact distribution, not from the normal approximation.
};

/// Do the values of two samples tend to differ? (H. B. Mann and D. R. Whitney, "On a test of
/// whether one of two random variables is stochastically larger than the other", Annals of
/// Mathematical Statistics 18, 1947.) Exact for samples of fewer than 50 without ties; else
/// the normal approximation with corrections for ties and continuity, as in R's wilcox.test.
/// Values may be infinite, not NaN; p is 1 if a sample is empty or all values are the same.
[[nodiscard]] HANDWAY_PLANNING_EXPORT MannWhitney mann_whitney(std::span<const double> first,
                                                               std::span<const double> second);

/// p-values of several tests so adjusted that the chance of one false finding among all
/// stays below that of each (S. Holm, "A simple sequentially rejective multiple test
/// procedure", Scandinavian Journal of Statistics 6, 1979). In the order of `p`.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<double> holm_adjusted(std::span<const double> p);

}  // namespace handway::planning
