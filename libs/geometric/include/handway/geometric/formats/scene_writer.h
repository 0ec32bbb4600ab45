#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/scene/scene.h"

#include <filesystem>
#include <string>

namespace handway::geometric {

/// Writes a scene file that read_scene() reads back as the same scene; numbers
/// in the shortest form that gives the same bits, the angles of poses rounded to
/// 1e-12 degrees. The file is replaced whole; a comment block at the top of the
/// old file is kept.
///
/// References: `RobotInstance::file` and `hand_basis` are kept as they are and,
/// if the scene moves to another folder, rewritten to name the same files;
/// meshes are named as by resource_reference(). Meshes that no mesh file holds
/// (made by a program or an importer) are saved as OBJ in the folder
/// `STEM_meshes` beside the scene.
///
/// Robots that come from no URDF are saved as `STEM_ROBOT.urdf` (write_urdf()).
///
/// @throws InputError if a file can't be written; the old scene file is then as
/// it was.
HANDWAY_GEOMETRIC_EXPORT void write_scene(const Scene& scene, const std::filesystem::path& file);

/// The scene's objects as the part `objects` of a scene file, to be read by read_objects() in any
/// scene: meshes are named by absolute paths.
/// @param meshes_beside a file; meshes that no mesh file holds are saved in STEM_meshes beside it.
/// @throws InputError if they can't be.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string objects_text(
    const Scene& scene, const std::filesystem::path& meshes_beside);

}  // namespace handway::geometric
