#pragma once

#include "handway/geometric/export.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace handway::geometric {

/// A path with its backslashes, as under Windows, as slashes; normal.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::filesystem::path with_slashes(
    const std::filesystem::path& path);

/// The file or folder that a path from a file means. Under Windows the case of letters does
/// not matter and folders are separated by backslashes: where there is nothing of exactly this
/// name, the only one that differs in these alone is taken.
/// @returns `path` itself if it exists, or if there is no such one or several.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::filesystem::path existing_file(
    const std::filesystem::path& path);

/// Returns whether `found`, the result of existing_file() for `written`, differs in case.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool differs_in_case(const std::filesystem::path& written,
                                                            const std::filesystem::path& found);

/// Returns whether the file's name ends with `extension`, in any case.
/// @param extension in small letters, with its dot: ".urdf".
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool has_extension(const std::filesystem::path& file,
                                                          std::string_view extension);

/// The folder of a ROS package, as `package://NAME/…` means it: a folder NAME that holds `folder`,
/// or beside one of those that do; else one in, or that itself is one of, the folders of
/// $HANDWAY_PACKAGE_PATH and $ROS_PACKAGE_PATH, or with packages of $AMENT_PREFIX_PATH; else one
/// near `folder` whose name has other letters.
/// @param folder absolute, of the file that names the package.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<std::filesystem::path> find_package(
    const std::string& name, const std::filesystem::path& folder);

/// Has packages and missing files looked for in this folder, as in those of $HANDWAY_PACKAGE_PATH,
/// for as long as the program runs. From any thread.
HANDWAY_GEOMETRIC_EXPORT void add_package_path(const std::filesystem::path& folder);

/// The file below `top`, at most six folders deep, that has the name of `file`; of several the one
/// whose path ends like that of `file` for longest.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<std::filesystem::path> find_file_below(
    const std::filesystem::path& top, const std::filesystem::path& file);

/// find_file_below() in the folders of $HANDWAY_PACKAGE_PATH and of add_package_path(), the first
/// that has one.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<std::filesystem::path> find_in_package_path(
    const std::filesystem::path& file);

}  // namespace handway::geometric
