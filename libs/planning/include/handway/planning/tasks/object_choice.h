#pragma once

#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/export.h"
#include "handway/planning/tasks/task.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// @file
/// Objects of which each motion of a data set uses one, drawn by its seed: objects of the scene, or
/// shapes and meshes with ranges of sizes that take the place of the object that a task picks.

namespace handway::planning {

/// Ends of a range of sizes, m, or of scales of a mesh; 0 < lower ≤ upper.
struct SizeRange {
  double lower = 0.0;
  double upper = 0.0;
};

/// An object that may be drawn.
struct ObjectChoice {
  std::string name;          ///< Unique among the choices.
  std::string scene_object;  ///< Object that is picked where it stands; empty: a shape is made.
  std::string shape;         ///< "box", "sphere", "cylinder", "cone" or "mesh"; empty: no shape.
  /// Ranges of a box's edges, of a radius, of radius and length, or of a mesh's scale.
  std::vector<SizeRange> sizes;
  std::filesystem::path mesh_file;                      ///< Absolute; empty: no mesh.
  std::shared_ptr<const geometric::TriangleMesh> mesh;  ///< With the scale 1.
  Eigen::Matrix3d R_WO = Eigen::Matrix3d::Identity();   ///< Orientation in which it stands.
};

/// A drawn object.
struct DrawnObject {
  std::size_t choice = 0;                 ///< Index of its ObjectChoice.
  std::vector<double> sizes;              ///< One for each range of the choice.
  std::optional<geometric::Shape> shape;  ///< Empty for an object of the scene.
};

/// Reads a file with a list `objects`. Each entry is `object: NAME` of the scene, or has a `box`,
/// `sphere`, `cylinder`, `cone` or `mesh` as in scene files, where each size is a number or a range
/// `[lower, upper]`, and may have a `name` and an orientation `rpy_deg`.
/// @param task picks one object, which stands in the world.
/// @throws InputError for another task, unknown objects, sizes that are not above 0, and ranges
/// whose lower end is above the upper one.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<ObjectChoice> read_object_choices(
    const std::filesystem::path& file, const geometric::Scene& scene, const Task& task);

/// Draws one of some objects, each with the same probability, and its sizes, evenly between the
/// ends of their ranges. Same arguments, same bits.
/// @pre there is a choice.
[[nodiscard]] HANDWAY_PLANNING_EXPORT DrawnObject draw_object(std::span<const ObjectChoice> choices,
                                                              std::uint64_t seed);

/// Returns the scene with the drawn shape in place of an object, standing on the middle of the
/// place of its underside. Grasps that the scene keeps for the object are left out. An object of
/// the scene is drawn as it is: then the scene stays.
/// @param target object that stands in the world. @param choice the one that `drawn` names.
/// @throws InputError if the scene has no such object.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_drawn_object(const SceneState& state,
                                                                   const std::string& target,
                                                                   const ObjectChoice& choice,
                                                                   const DrawnObject& drawn);

/// Returns the task with another object to pick in place of `target`.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Task with_picked_object(Task task, const std::string& target,
                                                              const std::string& object);

/// Returns the edges of the box around an object, along the axes of its frame; m.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Eigen::Vector3d size_of_object(
    const geometric::SceneObject& object);

}  // namespace handway::planning
