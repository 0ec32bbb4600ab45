#pragma once

#include "handway/geometric/export.h"

#include <filesystem>
#include <optional>
#include <string>
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

/// The folder of a ROS package, as `package://NAME/…` means it: a folder NAME that contains
/// `folder`, or beside one of its parents; else one in, or that itself is one of, the folders of
/// $HANDWAY_PACKAGE_PATH and $ROS_PACKAGE_PATH, or with packages of $AMENT_PREFIX_PATH; else one
/// near `folder` whose name differs in case.
/// @param folder absolute, of the file that names the package.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<std::filesystem::path> find_package(
    const std::string& name, const std::filesystem::path& folder);

/// Adds a folder in which packages and missing files are searched, like $HANDWAY_PACKAGE_PATH, for
/// as long as the program runs. From any thread.
HANDWAY_GEOMETRIC_EXPORT void add_package_path(const std::filesystem::path& folder);

/// The file below `top`, at most six folders deep, that has the name of `file`; of several the one
/// with the longest common end of the path.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<std::filesystem::path> find_file_below(
    const std::filesystem::path& top, const std::filesystem::path& file);

/// Calls find_file_below() for the folders of $HANDWAY_PACKAGE_PATH and of add_package_path();
/// returns the first result.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<std::filesystem::path> find_in_package_path(
    const std::filesystem::path& file);

}  // namespace handway::geometric
