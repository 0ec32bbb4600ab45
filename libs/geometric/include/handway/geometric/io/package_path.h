#pragma once

#include "handway/geometric/export.h"

#include <filesystem>
#include <optional>
#include <string>

namespace handway::geometric {

/// The folder of a ROS package, as `package://NAME/…` means it: a folder NAME that contains
/// `folder`, or beside one of its parents; else one in, or that itself is one of, the folders of
/// $HANDWAY_PACKAGE_PATH and $ROS_PACKAGE_PATH, or with packages of $AMENT_PREFIX_PATH; else one
/// near `folder` whose name differs in case, or whose manifest has the name.
/// @param folder absolute, of the file that names the package.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<std::filesystem::path> find_package(
    const std::string& name, const std::filesystem::path& folder);

/// Returns the name in the manifest of a package (`package.xml`); empty if the folder has none.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string package_name_of(
    const std::filesystem::path& folder);

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
