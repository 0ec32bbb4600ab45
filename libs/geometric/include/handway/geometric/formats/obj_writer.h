#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/mesh/point_cloud.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <filesystem>
#include <set>
#include <string>

namespace handway::geometric {

/// Writes a mesh as Wavefront OBJ, metres; the file is replaced whole.
/// @throws InputError if it can't be written.
HANDWAY_GEOMETRIC_EXPORT void write_obj(const TriangleMesh& mesh,
                                        const std::filesystem::path& file);

/// `name` with everything but ASCII letters, digits, - and _ replaced by _.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string file_name_of(const std::string& name);

/// The folder `STEM_meshes` beside a file STEM.*, for its meshes and point clouds that have no
/// file. It is created with the first of them.
class SavedMeshes {
 public:
  explicit SavedMeshes(const std::filesystem::path& file);

  /// Writes an OBJ file named after `name` and returns its path relative to the
  /// folder of the file. @throws InputError if it can't be written.
  [[nodiscard]] std::filesystem::path save(const std::string& name, const TriangleMesh& mesh);
  /// Writes a PLY file of points in the same way.
  [[nodiscard]] std::filesystem::path save(const std::string& name, const PointCloud& cloud);

 private:
  [[nodiscard]] std::filesystem::path new_file(const std::string& name, const char* extension);

  std::filesystem::path beside_;
  std::filesystem::path folder_;
  std::set<std::string> taken_;
};

}  // namespace handway::geometric
