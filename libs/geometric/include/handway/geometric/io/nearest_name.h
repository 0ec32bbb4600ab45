#pragma once

#include "handway/geometric/export.h"

#include <cstddef>
#include <optional>
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
/// The one of `names` that `word`, which is none of them, must be a slip of: at most two
/// letters off, whatever their case, and not the whole word.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<std::string> slip_of(
    std::string_view word, std::span<const std::string> names);

/// `Did you mean "NAME"?`, or the names there are if none is near and they are few.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string advise_name(std::string_view word,
                                                               std::span<const std::string> names);

}  // namespace handway::geometric
