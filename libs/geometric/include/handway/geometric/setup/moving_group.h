#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace handway::geometric {

/// The variables of a robot named by `name`: those of a group, of the robot or a part of it, or of
/// a joint. `PART/NAME` means a group or joint of that part, by the part's own name for it.
/// @returns ascending; empty if the robot has no independent joint of that name.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT JointIndices named_variables(const RobotInstance& robot,
                                                                    std::string_view name);

/// The moving variables of robots[0] by Scene::group, ascending; all if it is empty.
/// @pre the scene has a robot.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT JointIndices moving_variables(const Scene& scene);

/// Names that Scene::group may contain: groups of the first robot, robots, their parts, joints.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> movable_names(const Scene& scene);

/// Text "a group, robot or joint that moves: …" with all movable_names(), for messages.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string movable_names_text(const Scene& scene);

/// Returns whether a robot of the scene has a movable group, part or joint of that name.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool is_movable(const Scene& scene, std::string_view name);

/// Gives joints of the goal that don't move the start's values.
HANDWAY_GEOMETRIC_EXPORT void keep_still_in_goal(Scene& scene);

/// Restricts motion to `group`; everything moves if it is empty. Fixed robots that
/// `group` names become one robot with the first one, fixed to its base in their place
/// (mount_robot()). Joints that don't move any more take the start's values in the
/// goal.
/// @throws InputError for a name that no robot has, with the valid names; the scene is then
/// unchanged.
HANDWAY_GEOMETRIC_EXPORT void set_moving_group(Scene& scene, const std::vector<std::string>& group);

}  // namespace handway::geometric
