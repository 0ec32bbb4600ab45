#pragma once

#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace handway::import_kautham {

/// The triangles of an Open Inventor or VRML file.
struct InventorMesh {
  std::shared_ptr<const geometric::TriangleMesh> triangles;  ///< m
  geometric::Color color;                                    ///< Diffuse; the first triangle's.
  bool includes_files = false;                               ///< Parts of it come from other files.
  std::vector<std::string> warnings = {};                    ///< Textures that can't be read.
};

/// Reads an Open Inventor or VRML file whose lengths, times `scale`, are millimetres. Included
/// files are searched in its own folder.
/// @throws InputError if the file or one that it includes can't be read, or it
/// has no triangles.
[[nodiscard]] InventorMesh read_inventor_mesh(const std::filesystem::path& file, double scale);

/// Meshes by file and scale, each read once: also in later runs, because results are stored in the
/// user's cache by the file's content. Files that include others, or of which a texture can't be
/// read, are read in each run.
class InventorMeshes {
 public:
  /// @throws InputError as read_inventor_mesh().
  [[nodiscard]] const InventorMesh& load(const std::filesystem::path& file, double scale);

  /// Warnings about the files read so far.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::map<std::pair<std::filesystem::path, double>, InventorMesh> meshes_;
  std::vector<std::string> warnings_;
};

}  // namespace handway::import_kautham
