#pragma once

#include "inventor_mesh.h"

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace handway::import_kautham {

/// Meshes by file and scale, each read once: also in later runs, because what was read of a file
/// is kept in the user's cache by the file's content. Files that include others, or of which a
/// texture can't be read, are read in each run.
class InventorMeshes {
 public:
  /// @throws InputError as read_inventor_mesh().
  [[nodiscard]] const InventorMesh& load(const std::filesystem::path& file, double scale);

  /// What was noticed about the files read so far.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::map<std::pair<std::filesystem::path, double>, InventorMesh> meshes_;
  std::vector<std::string> warnings_;
};

}  // namespace handway::import_kautham
