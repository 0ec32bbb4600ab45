#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace handway::geometric {

/// The version of the scene format that this program reads and writes.
inline constexpr int kSceneVersion = 1;

/// Reads a scene file (YAML; docs/scene-format.md), its robots and its meshes.
///
/// RobotInstance::file and Scene::hand_basis keep the reference as written in the file
/// (find_resource() makes a path of it); Mesh::file is absolute. A joint missing in
/// `configuration` has the model's neutral() value; one missing in `start` or `goal` has the
/// value in `configuration`. Start and goal may be out of limits or in collision: planners report
/// it.
///
/// @throws InputError naming file, line and element of the error.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Scene read_scene(const std::filesystem::path& file);

/// Reads the objects of a text that is a scene file or its part `objects`, as objects_text() writes
/// it, with their display settings. Meshes are named by absolute paths or are of the library.
/// @param source origin of the text, for messages. @param scene with its robots, to which objects
/// may be attached.
/// @returns a scene of objects alone, under the names of the text.
/// @throws InputError naming source, line and element of the error.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Scene read_objects(const std::string& text,
                                                          const std::string& source,
                                                          const Scene& scene);

/// The constraints of a text that is a list of them, as in a scene file. @param source origin of
/// the text, for messages. @param scene whose bodies they refer to.
/// @throws InputError naming source, line and element of the error.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<PathConstraint> read_constraints(
    const std::string& text, const std::string& source, const Scene& scene);

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
/// Robots without a URDF are saved as `STEM_ROBOT.urdf` (write_urdf()).
///
/// @throws InputError if a file can't be written; the old scene file is then as
/// it was.
HANDWAY_GEOMETRIC_EXPORT void write_scene(const Scene& scene, const std::filesystem::path& file);

/// The scene's objects as the part `objects` of a scene file, to be read by read_objects() in any
/// scene: meshes are named by absolute paths.
/// @param meshes_beside a file; meshes without a file are saved in STEM_meshes beside it.
/// @throws InputError if that fails.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string objects_text(
    const Scene& scene, const std::filesystem::path& meshes_beside);

}  // namespace handway::geometric
