#pragma once

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/scene/scene.h"

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace handway::import_moveit {

/// Poses of frames in the world by name: the robot's links, "world" and those that the scene
/// names (`fixed_frame_transforms`).
using Frames = std::map<std::string, geometric::Pose>;

/// Where the frame of a message's `header` is in the world; "world" if it names none.
/// @throws InputError if there is no such frame.
[[nodiscard]] geometric::Pose frame_of(const geometric::YamlElement& message, const Frames& frames);

/// The `primitives` of a message with their poses, `primitive_poses`, in the message's frame.
/// @throws InputError naming what is wrong with one.
[[nodiscard]] std::vector<std::pair<geometric::Shape, geometric::Pose>> read_primitives(
    const geometric::YamlElement& message);

/// Adds the collision objects of `world` (moveit_msgs/PlanningSceneWorld) to `scene`: an
/// object of the scene for each primitive and each mesh.
/// @param folder of the problem, for meshes.
/// @throws InputError for what can't be read, and for planes and octomaps.
void add_world(const geometric::YamlElement& world, const Frames& frames,
               const std::filesystem::path& folder, geometric::Scene& scene);

/// Adds what the first robot carries (moveit_msgs/AttachedCollisionObject).
/// @throws InputError as add_world().
void add_attached(const geometric::YamlElement& attached, const Frames& frames,
                  const std::filesystem::path& folder, geometric::Scene& scene);

}  // namespace handway::import_moveit
