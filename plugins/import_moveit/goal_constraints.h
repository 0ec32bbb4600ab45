#pragma once

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/scene/scene.h"
#include "world_objects.h"

#include <vector>

namespace handway::import_moveit {

/// Whether a goal (moveit_msgs/Constraints) says where a link has to be.
[[nodiscard]] bool has_pose(const geometric::YamlElement& goal);

/// The poses of such a goal: one position constraint, one orientation constraint or one of each, of
/// the same link. A region of several primitives makes a goal of each.
///
/// Tolerances are along the goal's axes: where a box lies across them, or a region is round, they
/// are those of the largest cube inside.
/// @param model the planned robot. @param frames where headers' frames are in the world.
/// @throws InputError for other constraints, regions of meshes, links that the robot has not or
/// that no joint moves.
[[nodiscard]] std::vector<geometric::PoseGoal> read_pose_goals(const geometric::YamlElement& goal,
                                                               const geometric::RobotModel& model,
                                                               const Frames& frames);

}  // namespace handway::import_moveit
