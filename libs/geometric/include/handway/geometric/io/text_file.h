#pragma once

#include "handway/geometric/export.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace handway::geometric {

/// The whole content of a file that people write: UTF-8 text without control
/// characters, a byte-order mark removed.
/// @param what what the file should be, for messages: "a robot file (URDF)".
/// @throws InputError if it is missing, a folder, device or pipe, unreadable, empty, larger than
/// `limit` bytes, or no text; a byte that is no text is named with its line.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string read_text_file(
    const std::filesystem::path& file, const std::string& what,
    std::size_t limit = std::size_t{64} << 20);

}  // namespace handway::geometric
