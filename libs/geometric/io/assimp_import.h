#pragma once

#include "handway/geometric/scene/triangle_mesh.h"

#include <filesystem>
#include <string>

namespace handway::geometric {

/// All triangles of a mesh file in its root frame, as assimp reads it: neither
/// joined nor checked. The contract of units and axes is that of read_mesh().
/// @throws std::runtime_error with assimp's reason if it can't be read.
[[nodiscard]] TriangleMesh import_triangles(const std::filesystem::path& file);

/// Does assimp know files that end like this one?
[[nodiscard]] bool can_import(const std::filesystem::path& file);

}  // namespace handway::geometric
