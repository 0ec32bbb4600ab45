#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/collision/continuous/motion_bound.h"
#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/export.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <memory>
#include <vector>

namespace handway::planning {

using geometric::Configuration;

/// A query ready to plan: the first robot of a scene, its joints split into arm
/// and hand, the hand's basis, start and goal (paper, section 2: C = C^h × C^a).
struct PlanningProblem {
  std::shared_ptr<const geometric::Scene> scene;
  std::shared_ptr<const sampling::PmdBasis> basis;  ///< Null: the hand has none.
  std::vector<int> arm;                             ///< Variables of the arm, in order.
  std::vector<int> hand;  ///< Variables of the hand, in the basis' joint order.
  Configuration start;    ///< c_ini
  Configuration goal;     ///< c_goal
  std::shared_ptr<const geometric::CollisionChecker> checker;  ///< To clone, one per thread.
  std::shared_ptr<const geometric::MotionBound> motion;

  [[nodiscard]] const geometric::RobotModel& model() const { return *scene->robots.front().model; }
};

/// Puts a problem together. The hand are the basis' joints, or else those of the robot's group
/// "hand"; the arm are the others of the group "arm" or, if none of them moves, of the robot.
/// Either may be empty. Start and goal are the scene's, the goal with
/// continuous joints within half a turn of the start.
/// @param basis may be null.
/// @throws InputError if the scene lacks a robot, a start or a goal, or the
/// basis names a joint that the robot has not; PreparationStopped where `preparation` asks for it.
[[nodiscard]] HANDWAY_PLANNING_EXPORT PlanningProblem make_problem(
    std::shared_ptr<const geometric::Scene> scene, std::shared_ptr<const sampling::PmdBasis> basis,
    const geometric::Preparation& preparation = {});

/// What make_problem() makes of a changed scene, sharing with the problem of the scene before all
/// that the change left alone: the checker, or at least the meshes that it has prepared.
/// @throws as make_problem().
[[nodiscard]] HANDWAY_PLANNING_EXPORT PlanningProblem
updated_problem(const PlanningProblem& before, std::shared_ptr<const geometric::Scene> scene,
                std::shared_ptr<const sampling::PmdBasis> basis,
                const geometric::Preparation& preparation = {});

/// Distance of two configurations in joints normalised to [0, 1] (paper, section 7).
[[nodiscard]] HANDWAY_PLANNING_EXPORT double normalised_distance(const geometric::RobotModel& model,
                                                                 const Configuration& a,
                                                                 const Configuration& b);

/// Where the arm is on its straight motion from start to goal, in [0, 1]: of the nearest
/// configuration on it; 0 for an arm that has nothing to move.
[[nodiscard]] HANDWAY_PLANNING_EXPORT double arm_progress(const PlanningProblem& problem,
                                                          const Configuration& q);

}  // namespace handway::planning
