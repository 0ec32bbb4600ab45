#pragma once

#include "handway/geometric/export.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace handway::geometric {

/// The one of `names` with the smallest edit distance to `word`, for advice on
/// misspelt names; empty if none is near (more than a third of the letters off).
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string nearest_name(std::string_view word,
                                                                std::span<const std::string> names);

/// The `count` of `names`, or all if there are fewer, with the smallest edit distances to `word`,
/// nearest first, however far they are.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> nearest_names(
    std::string_view word, std::span<const std::string> names, std::size_t count);

/// `Did you mean "NAME"?`, or the names there are if none is near and they are few.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string advise_name(std::string_view word,
                                                               std::span<const std::string> names);

}  // namespace handway::geometric
