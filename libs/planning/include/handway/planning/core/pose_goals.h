#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/export.h"

#include <cstddef>
#include <string>
#include <vector>

namespace handway::planning {

/// A configuration in which the robot reaches one of the scene's goal poses, and in which a path
/// can end.
struct GoalCandidate {
  geometric::Configuration q;  ///< Configuration of the whole robot.
  std::size_t pose = 0;        ///< Index into Scene::goal_poses.
};

/// Result of inverse kinematics for a scene's goal poses.
struct PoseGoalSolutions {
  std::vector<GoalCandidate> candidates;  ///< The nearest to the start first, in normalised joints.
  /// Reason if there are no candidates, as a sentence: the distance from the poses, or the bodies
  /// that collide in all configurations that reach them. Empty otherwise.
  std::string fault;
  geometric::Configuration nearest;  ///< The first candidate, or else the nearest configuration.
};

/// Finds configurations at the scene's goal poses, several for each, by numeric inverse kinematics
/// from many starts over all joints that move the goal's link. They keep their limits, are free of
/// collision and obey the constraints. At first the tool goes exactly to the pose, axes that are
/// free excepted; if no free configuration reaches it, anywhere within the tolerances. The other
/// joints are as in the scene's goal or, if it has none, in `start`. Same arguments, same bits.
/// @param start shape [variable_count].
/// @pre the scene has goal poses; their links are the robot's, and joints move them.
[[nodiscard]] HANDWAY_PLANNING_EXPORT PoseGoalSolutions
solve_pose_goals(const geometric::Scene& scene, const geometric::CollisionChecker& checker,
                 const geometric::Configuration& start);

/// Describes the goal poses that the robot misses in `q`, to within rounding (1 µm, 1 µrad); empty
/// if it reaches one of them.
/// @returns the distance of the nearest: "misses goal pose 2 of link tool by 3 mm and 1 degrees".
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string pose_goal_miss(const geometric::Scene& scene,
                                                                 const geometric::Configuration& q);

/// Text "goal pose 2 of link tool"; without the number if it is the only one.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string name_of_pose_goal(const geometric::Scene& scene,
                                                                    std::size_t pose);

}  // namespace handway::planning
