#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_model.h"

#include <filesystem>

namespace handway::geometric {

/// Writes a robot as URDF, with its groups, postures and allowed collisions as
/// SRDF beside it (same stem), so that load_robot() gives back the same model.
///
/// Mesh files are named relative to the URDF's folder where they lie in it, by
/// absolute path otherwise. Cones (which URDF does not know) and meshes without
/// a file that read_mesh() could read are saved as OBJ in `STEM_meshes`. Unknown
/// velocity limits are written as 0; acceleration limits have no place in URDF
/// and are lost. Each file is replaced whole.
/// @throws InputError if a file can't be written.
HANDWAY_GEOMETRIC_EXPORT void write_urdf(const RobotModel& model,
                                         const std::filesystem::path& file);

}  // namespace handway::geometric
