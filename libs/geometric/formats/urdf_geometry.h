#pragma once

#include "formats/urdf_elements.h"
#include "handway/geometric/robot/robot_description.h"

#include <urdf_model/link.h>

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace handway::geometric {

/// What was noticed about the files that links name.
struct LinkFiles {
  DrawingFaults drawing;             ///< What can't be drawn.
  std::set<std::string> renamed;     ///< Mesh files whose names have other letters than written.
  std::set<std::string> found;       ///< Meshes that were not there, with the files taken instead.
  std::optional<InputProblem> lost;  ///< The first collision mesh that is nowhere.
  std::set<std::string> all_lost;    ///< The names of all of these.

  /// @throws MissingMeshError if collision meshes are nowhere.
  void refuse_missing() const;

  /// "meshes that are not where the file says were looked for: …"; empty if there are none.
  [[nodiscard]] std::string found_elsewhere() const;
};

/// A pose as URDF gives it, X_PJ or X_LG.
[[nodiscard]] Pose pose_of(const urdf::Pose& pose);

/// The link with its shapes; mesh files are read. A visual mesh that can't be read is left
/// out and noted.
/// @param folder of the URDF file, absolute.
/// @param referenced_by "FILE:LINE" of the link, for messages.
/// A collision mesh that is nowhere is left out and noted, too: refuse_missing() names all at once.
/// @throws InputError if a size is not positive or a collision mesh can't be read.
[[nodiscard]] Link link_of(const urdf::Link& link, const std::filesystem::path& folder,
                           const std::string& referenced_by, LinkFiles& files);

}  // namespace handway::geometric
