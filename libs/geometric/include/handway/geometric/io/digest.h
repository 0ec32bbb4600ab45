#pragma once

#include "handway/geometric/export.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace handway::geometric {

/// Tells contents apart (XXH3, 128 bits), for all that the program remembers of any.
using Digest = std::array<std::uint8_t, 16>;

[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Digest digest_of(std::string_view content);

/// The digest of a file's bytes in hexadecimal digits; empty if it can't be read.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string digest_of_file(
    const std::filesystem::path& file);

}  // namespace handway::geometric
