#pragma once

#include "handway/geometric/export.h"

#include <filesystem>
#include <optional>
#include <string>

namespace handway::geometric {

/// The folder of a ROS package, as `package://NAME/…` means it: a folder NAME that holds `folder`,
/// or beside one of those that do; else one in, or that itself is one of, the folders of
/// $HANDWAY_PACKAGE_PATH and $ROS_PACKAGE_PATH, or with packages of $AMENT_PREFIX_PATH; else one
/// near `folder` whose name has other letters.
/// @param folder absolute, of the file that names the package.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<std::filesystem::path> find_package(
    const std::string& name, const std::filesystem::path& folder);

}  // namespace handway::geometric
