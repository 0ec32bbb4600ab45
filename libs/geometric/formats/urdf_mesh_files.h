#pragma once

#include "formats/xml_document.h"
#include "handway/geometric/formats/urdf.h"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace handway::geometric {

/// Finds the mesh files that a URDF file names; see read_urdf().
class UrdfMeshFiles {
 public:
  /// @param folder base of relative names, absolute.
  UrdfMeshFiles(const XmlDocument& document, std::filesystem::path folder);

  /// Returns the file of a <mesh>, and notes names that are not the file's own.
  /// @param element for messages.
  /// @throws MissingMeshError if there is none.
  [[nodiscard]] std::filesystem::path find(const pugi::xml_node& mesh, const std::string& element);

  /// Returns warnings about files that were found elsewhere, or under names in other letters.
  [[nodiscard]] std::vector<std::string> warnings() const;

 private:
  /// MuJoCo's folder for the meshes: `<mujoco><compiler meshdir="…" strippath="…"/></mujoco>`.
  struct MujocoCompiler {
    std::filesystem::path mesh_folder;  ///< From the robot's folder.
    bool strips_path = true;            ///< Folders in names of files are ignored.
  };

  [[nodiscard]] static std::optional<MujocoCompiler> mujoco_compiler(const pugi::xml_node& robot);
  [[nodiscard]] std::optional<std::filesystem::path> find_by_compiler(
      const std::string& filename) const;
  [[nodiscard]] std::filesystem::path find_as_written(const std::string& filename,
                                                      const std::string& element,
                                                      const std::string& where) const;
  [[nodiscard]] std::string found_elsewhere() const;

  const XmlDocument& document_;
  std::filesystem::path folder_;
  std::optional<MujocoCompiler> compiler_;
  std::set<std::string> by_compiler_;  ///< Meshes found by MuJoCo's settings.
  std::set<std::string> renamed_;      ///< Mesh files whose names differ in case.
  std::set<std::string> found_;        ///< Missing meshes, with the files taken instead.
};

}  // namespace handway::geometric
