#pragma once

#include "handway/geometric/robot/link.h"

#include <urdf_model/link.h>

#include <filesystem>
#include <string>

namespace handway::geometric {

/// A pose as URDF gives it, X_PJ or X_LG.
[[nodiscard]] Pose pose_of(const urdf::Pose& pose);

/// The link with its shapes; mesh files are read.
/// @param folder of the URDF file, absolute.
/// @param referenced_by "FILE:LINE" of the link, for messages.
/// @throws InputError if a size is not positive or a mesh can't be read.
[[nodiscard]] Link link_of(const urdf::Link& link, const std::filesystem::path& folder,
                           const std::string& referenced_by);

}  // namespace handway::geometric
