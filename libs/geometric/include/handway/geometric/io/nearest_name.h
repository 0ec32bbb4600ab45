#pragma once

#include "handway/geometric/export.h"

#include <span>
#include <string>
#include <string_view>

namespace handway::geometric {

/// The one of `names` with the smallest edit distance to `word`, for advice on
/// misspelt names; empty if none is near (more than a third of the letters off).
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string nearest_name(std::string_view word,
                                                                std::span<const std::string> names);

/// `Did you mean "NAME"?`, or the names there are if none is near and they are few.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string advise_name(std::string_view word,
                                                               std::span<const std::string> names);

}  // namespace handway::geometric
