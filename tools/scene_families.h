#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/scene/scene.h"
#include "handway/sampling/sequences/random_stream.h"

#include <span>
#include <string>
#include <vector>

namespace handway::tools {

/// Height of the table of all generated scenes, m.
inline constexpr double kTableHeight = 0.74;

/// Objects around a place on the table.
struct Surroundings {
  std::vector<geometric::SceneObject> objects;
  std::string target;                 ///< Object to reach, to grasp or to place.
  std::vector<std::string> supports;  ///< Objects on which the target may stand.
};

/// A kind of scenes: a table with something around the target.
struct SceneFamily {
  const char* name;
  const char* description;
};

/// All families, in the order of their indices.
[[nodiscard]] std::span<const SceneFamily> scene_families();

/// Draws a scene of a family.
/// @param family index into scene_families(). @param level 1 to 3: gaps get narrower and obstacles
/// more.
/// @param X_WF place of the target on the table: z upwards, x away from the robot.
[[nodiscard]] Surroundings draw_surroundings(std::size_t family, int level,
                                             const geometric::Pose& X_WF,
                                             sampling::RandomStream& random);

}  // namespace handway::tools
