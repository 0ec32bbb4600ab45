#pragma once

#include "handway/geometric/export.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace handway::geometric {

/// Tells contents apart (XXH3, 128 bits).
using CacheKey = std::array<std::uint8_t, 16>;

/// The key of `content`, told apart from other ways of making things of it by
/// `made_how`.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT CacheKey cache_key(std::string_view made_how,
                                                          std::string_view content);

/// What was kept in the user's cache ($XDG_CACHE_HOME/handway, else
/// ~/.cache/handway), if it is there and whole: what is broken is as good as not
/// there.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<std::string> read_cached(const CacheKey& key);

/// Keeps `bytes` in the cache, if there is one and it can be written; the oldest
/// entries go when there are too many.
HANDWAY_GEOMETRIC_EXPORT void write_cached(const CacheKey& key, const std::string& bytes);

}  // namespace handway::geometric
