#pragma once

#include "formats/urdf_elements.h"
#include "handway/geometric/formats/urdf.h"
#include "handway/geometric/robot/robot_description.h"

#include <urdf_model/link.h>

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace handway::geometric {

/// MuJoCo's folder for the meshes of a URDF file: `<mujoco><compiler meshdir="…"
/// strippath="…"/></mujoco>`.
struct MujocoCompiler {
  std::filesystem::path mesh_folder;  ///< From the robot's folder.
  bool strips_path = true;            ///< Folders in names of files are ignored.
};

/// Notes about the files that links name.
struct LinkFiles {
  std::optional<MujocoCompiler> compiler;  ///< Settings of MuJoCo in the file.
  std::set<std::string> by_compiler;       ///< Meshes found by its settings.
  DrawingFaults drawing;                   ///< Elements that can't be drawn.
  std::set<std::string> renamed;           ///< Mesh files whose names differ in case.
  std::set<std::string> found;             ///< Missing meshes, with the files taken instead.
  MissingMeshes missing;                   ///< Collision meshes that were not found.

  /// Text "meshes that are not where the file says were looked for: …"; empty without any.
  [[nodiscard]] std::string found_elsewhere() const;
};

/// A pose as URDF gives it, X_PJ or X_LG.
[[nodiscard]] Pose pose_of(const urdf::Pose& pose);

/// The link with its shapes; mesh files are read. A visual mesh that can't be read is left
/// out and noted.
/// @param folder of the URDF file, absolute.
/// @param referenced_by "FILE:LINE" of the link, for messages. A collision mesh that is not found
/// is left out and noted, too, to be refused with all others.
/// @throws InputError if a size is not positive or a collision mesh can't be read.
[[nodiscard]] Link link_of(const urdf::Link& link, const std::filesystem::path& folder,
                           const std::string& referenced_by, LinkFiles& files);

}  // namespace handway::geometric
