#pragma once

#include "inventor_mesh.h"

#include <filesystem>
#include <map>
#include <utility>

namespace handway::import_kautham {

/// Meshes by file and scale, each read once: also in later runs, because what was read of a file
/// is kept in the user's cache by the file's content. Files that include others are read anew in
/// each run.
class InventorMeshes {
 public:
  /// @throws InputError as read_inventor_mesh().
  [[nodiscard]] const InventorMesh& load(const std::filesystem::path& file, double scale);

 private:
  std::map<std::pair<std::filesystem::path, double>, InventorMesh> meshes_;
};

}  // namespace handway::import_kautham
