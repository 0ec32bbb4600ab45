#pragma once

#include "handway/geometric/export.h"

#include <array>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace handway::geometric {

/// Hash of a content (XXH3, 128 bits), for all caches of the program.
using Digest = std::array<std::uint8_t, 16>;

/// Returns the digest of a content.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Digest digest_of(std::string_view content);

/// The digest of a file's bytes in hexadecimal digits; empty if it can't be read.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string digest_of_file(
    const std::filesystem::path& file);

/// Name of an entry of the disk cache.
using CacheKey = Digest;

/// The key of data that this version of the program derives from `content`.
/// @param layout kind of the data and its layout as bytes: to change with either.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT CacheKey cache_key(std::string_view layout,
                                                          std::string_view content);

/// A folder of data that take long to derive, one entry per key. Each carries a checksum of its key
/// and its bytes: entries that are truncated, changed, copied from another entry or no file count
/// as missing. Nothing here fails: without a folder that can be read and written, nothing is
/// stored. For any thread and several processes at a time.
class HANDWAY_GEOMETRIC_EXPORT DiskCache {
 public:
  static constexpr std::uintmax_t kBudget = std::uintmax_t{512} << 20;  ///< Bytes.

  /// The user's cache: $XDG_CACHE_HOME/handway/meshes, else ~/.cache/handway/meshes. Removes the
  /// folder that early versions used.
  [[nodiscard]] static DiskCache of_user();

  /// @param folder is created with the first entry; empty: nothing is stored.
  /// @param budget bytes that all entries may take together.
  explicit DiskCache(std::filesystem::path folder, std::uintmax_t budget = kBudget);

  [[nodiscard]] std::optional<std::string> read(const CacheKey& key) const;

  /// Returns the entry's bytes, decoded by `decode`; nothing if absent or if `decode` throws.
  template <typename Decode>
  [[nodiscard]] auto read_as(const CacheKey& key, const Decode& decode) const
      -> std::optional<std::invoke_result_t<Decode, const std::string&>> {
    if (const std::optional<std::string> bytes = read(key)) {
      try {
        return decode(*bytes);
      } catch (const std::exception&) {  // to be derived again
      }
    }
    return std::nullopt;
  }

  /// Removes the least recently used entries if the budget is exceeded.
  void write(const CacheKey& key, std::string_view bytes) const;

 private:
  [[nodiscard]] std::filesystem::path file_of(const CacheKey& key) const;
  void keep_within_budget() const;

  std::filesystem::path folder_;
  std::uintmax_t budget_;
};

}  // namespace handway::geometric
