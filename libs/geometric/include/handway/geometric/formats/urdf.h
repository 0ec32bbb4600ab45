#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/robot_description.h"
#include "handway/geometric/robot/robot_model.h"

#include <filesystem>
#include <optional>
#include <set>
#include <string>

namespace handway::geometric {

/// Thrown for a collision mesh that is not found: add_package_path() may help.
class HANDWAY_GEOMETRIC_EXPORT MissingMeshError : public InputError {
 public:
  using InputError::InputError;
};

/// Collects missing collision meshes of a robot file, so that one message reports
/// all.
class HANDWAY_GEOMETRIC_EXPORT MissingMeshes {
 public:
  /// @param name of the mesh, which counts once.
  void add(const InputProblem& problem, const std::string& name);
  /// @throws MissingMeshError with the first problem, if any.
  void refuse() const;

 private:
  std::optional<InputProblem> first_;
  std::set<std::string> names_;
};

/// Reads a robot from a URDF file (http://wiki.ros.org/urdf/XML).
///
/// - Joints: `revolute`, `prismatic`, `fixed`, `continuous` (revolute with infinite
///   limits, see Joint::is_continuous()); `planar` and `floating` (chains of slides
///   and rotations, see add_base_joint()); `mimic`, also in chains. A velocity limit
///   of 0 counts as unknown (infinity). URDF has no acceleration limits; they stay
///   infinite.
/// - Geometry: box, sphere, cylinder, mesh; all `visual` and `collision`
///   elements; colours of materials, global ones included. Mesh::file is
///   absolute.
/// - Mesh file names: relative to the URDF's folder; absolute; `file://PATH`;
///   `package://NAME/REST`, NAME being a folder above the URDF, or a neighbour of one of these, or
///   a package of $ROS_PACKAGE_PATH or $AMENT_PREFIX_PATH. Missing files are searched in the
///   package path (find_in_package_path()), with a warning.
/// - Links and joints keep the order of the file.
/// - An SRDF file beside it with the same stem is read too (see read_srdf()).
///
/// @throws InputError naming the line if the file or one that it names can't be read or is not
/// URDF; MissingMeshError for a missing mesh.
/// @param folder base of relative mesh names, if it is not the file's; no SRDF is read
/// then.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT RobotDescription
read_urdf(const std::filesystem::path& file, const std::filesystem::path& folder = {});

/// Writes a robot as URDF, with its groups, postures and allowed collisions as
/// SRDF beside it (same stem), so that load_robot() gives back the same model.
///
/// Mesh files are named relative to the URDF's folder if they lie in it, by absolute
/// path otherwise. Cones (which URDF lacks) and meshes without a file that read_mesh()
/// could read are saved as OBJ in `STEM_meshes`. Unknown velocity limits are written as
/// 0; acceleration limits have no place in URDF and are lost. Each file is replaced
/// whole.
/// @throws InputError if a file can't be written.
HANDWAY_GEOMETRIC_EXPORT void write_urdf(const RobotModel& model,
                                         const std::filesystem::path& file);

}  // namespace handway::geometric
