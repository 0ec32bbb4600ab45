#pragma once

#include "handway/geometric/export.h"

#include <filesystem>
#include <string_view>

namespace handway::geometric {

/// The file or folder that a path from a file means. Under Windows the case of letters does
/// not matter and folders are separated by backslashes: where there is nothing of exactly this
/// name, the only one that differs in these alone is taken.
/// @returns `path` itself if it exists, or if there is no such one or several.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::filesystem::path existing_file(
    const std::filesystem::path& path);

/// Whether `found`, which existing_file() gave for `written`, has other letters.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool differs_in_case(const std::filesystem::path& written,
                                                            const std::filesystem::path& found);

/// Whether the file's name ends like this, in whatever letters.
/// @param extension in small letters, with its dot: ".urdf".
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool has_extension(const std::filesystem::path& file,
                                                          std::string_view extension);

}  // namespace handway::geometric
