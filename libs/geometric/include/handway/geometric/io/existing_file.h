#pragma once

#include "handway/geometric/export.h"

#include <filesystem>
#include <string_view>

namespace handway::geometric {

/// Returns a normalized path with slashes in place of the backslashes of Windows.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::filesystem::path with_slashes(
    const std::filesystem::path& path);

/// Finds the file or folder that a path from a file means. Under Windows, paths are
/// case-insensitive and have backslashes: if no file has exactly this name, the only one that
/// differs in these alone is taken.
/// @returns `path` itself if it exists, or if no such file or several exist.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::filesystem::path existing_file(
    const std::filesystem::path& path);

/// Returns whether `found`, the result of existing_file() for `written`, differs in case.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool differs_in_case(const std::filesystem::path& written,
                                                            const std::filesystem::path& found);

/// Returns whether the file's name ends with `extension`, in any case.
/// @param extension in small letters, with its dot: ".urdf".
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool has_extension(const std::filesystem::path& file,
                                                          std::string_view extension);

}  // namespace handway::geometric
