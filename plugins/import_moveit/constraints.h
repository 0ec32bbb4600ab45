#pragma once

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/scene/scene.h"
#include "world_objects.h"

#include <vector>

namespace handway::import_moveit {

/// Returns whether a goal (moveit_msgs/Constraints) constrains the pose of a link.
[[nodiscard]] bool has_pose(const geometric::YamlElement& goal);

/// The poses of such a goal: one position constraint, one orientation constraint or one of each, of
/// the same link. A region of several primitives gives a goal for each.
///
/// Tolerances are along the goal's axes: for a box across them, or a round region, they are those
/// of the largest cube inside.
/// @param model the planned robot. @param frames poses of the headers' frames in the world.
/// @param held frames that constraints may name instead of a link.
/// @throws InputError for other constraints, regions of meshes, links that the robot lacks or that
/// no joint moves.
[[nodiscard]] std::vector<geometric::PoseGoal> read_pose_goals(const geometric::YamlElement& goal,
                                                               const geometric::RobotModel& model,
                                                               const Frames& frames,
                                                               const HeldFrames& held);

/// Reads constraints that hold all along a path: the position of a link's point (position
/// constraints) and the orientation of a link (orientation constraints).
///
/// Tolerances become cones: of one axis of the link, if it may turn about that freely, else of two.
/// They are the largest within the message's tolerances. Only about the y axis the cone replaces
/// the tolerance, for Euler angles don't describe what is meant there. Round regions become the
/// largest cube inside.
/// @param path moveit_msgs/Constraints. @param model, @param frames, @param held as above.
/// @throws InputError for other constraints and regions, for links that the robot lacks or that no
/// joint moves, for frames that move, and for a link that is free about two axes alone.
[[nodiscard]] std::vector<geometric::PathConstraint> read_path_constraints(
    const geometric::YamlElement& path, const geometric::RobotModel& model, const Frames& frames,
    const HeldFrames& held);

}  // namespace handway::import_moveit
