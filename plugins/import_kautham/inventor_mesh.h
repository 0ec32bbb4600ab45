#pragma once

#include "handway/geometric/scene/color.h"
#include "handway/geometric/scene/triangle_mesh.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace handway::import_kautham {

/// The triangles of an Open Inventor or VRML file.
struct InventorMesh {
  std::shared_ptr<const geometric::TriangleMesh> triangles;  ///< m
  geometric::Color color;                                    ///< Diffuse, of the first triangle.
  bool includes_files = false;                               ///< Parts of it come from others.
  std::vector<std::string> warnings = {};                    ///< Textures that can't be read.
};

/// Reads an Open Inventor or VRML file whose lengths, times `scale`, are
/// millimetres. Files that it includes are looked for in its own folder.
/// @throws InputError if the file or one that it includes can't be read, or it
/// has no triangles.
[[nodiscard]] InventorMesh read_inventor_mesh(const std::filesystem::path& file, double scale);

}  // namespace handway::import_kautham
