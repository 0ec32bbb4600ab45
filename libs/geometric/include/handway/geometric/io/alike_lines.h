#pragma once

#include "handway/geometric/export.h"

#include <string>
#include <vector>

namespace handway::geometric {

/// Merges similar lines: at least six of ten words are the same, in their order. The first line
/// stands for all, with a count and the names of some others: "joint a is limited (2 more alike: b,
/// c)". The order is kept.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> merged_alike(
    const std::vector<std::string>& lines);

}  // namespace handway::geometric
