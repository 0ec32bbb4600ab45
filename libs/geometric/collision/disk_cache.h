#pragma once

#include <boost/uuid/uuid.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace handway::geometric {

/// Tells contents apart.
using CacheKey = boost::uuids::uuid;

/// The key of `content`, told apart from other ways of making things of it by
/// `made_how`.
[[nodiscard]] CacheKey cache_key(std::string_view made_how, std::string_view content);

/// What was kept in the user's cache ($XDG_CACHE_HOME/handway, else
/// ~/.cache/handway), if it is there and whole: what is broken is as good as not
/// there.
[[nodiscard]] std::optional<std::string> read_cached(const CacheKey& key);

/// Keeps `bytes` in the cache, if there is one and it can be written; the oldest
/// entries go when there are too many.
void write_cached(const CacheKey& key, const std::string& bytes);

}  // namespace handway::geometric
