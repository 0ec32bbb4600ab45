#pragma once

#include <filesystem>
#include <string>

namespace handway::geometric {

/// The file that a robot file means by a mesh's `filename` (see read_urdf()).
/// @param folder of the robot file, absolute.
/// @param referenced_by "FILE:LINE", for messages.
/// @throws InputError if a package is not found or the scheme is unknown.
[[nodiscard]] std::filesystem::path resolve_mesh_filename(const std::string& filename,
                                                          const std::filesystem::path& folder,
                                                          const std::string& referenced_by);

}  // namespace handway::geometric
