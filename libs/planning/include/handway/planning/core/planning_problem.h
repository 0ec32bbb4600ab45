#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/collision/continuous/motion_bound.h"
#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/pose_goals.h"
#include "handway/planning/export.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <memory>
#include <string>
#include <vector>

namespace handway::planning {

/// A polyline in configuration space; between two waypoints all joints move
/// linearly together.
struct Path {
  std::vector<geometric::Configuration> waypoints;

  [[nodiscard]] bool empty() const { return waypoints.empty(); }
};

using geometric::Configuration;

/// A query ready to plan: the first robot of a scene, its joints split into arm
/// and hand, the hand's basis, start and goal (paper, section 2: C = C^h × C^a).
struct PlanningProblem {
  std::shared_ptr<const geometric::Scene> scene;
  std::shared_ptr<const sampling::PmdBasis> basis;  ///< Null: the hand has none.
  /// Variables that may move, ascending (geometric::Scene::group). The others are in neither arm
  /// nor hand, and planners leave them where the start has them.
  std::vector<int> moving;
  std::vector<int> arm;   ///< Variables of the arm, in order.
  std::vector<int> hand;  ///< Variables of the hand, in the basis' joint order.
  Configuration start;    ///< c_ini
  Configuration goal;     ///< c_goal
  /// Of a scene with goal poses: configurations that reach one of them. `goal` is the first, and
  /// planners take any. Empty: `goal` is the only one.
  std::vector<GoalCandidate> goals;
  std::string goal_fault;  ///< Why no configuration reaches a goal pose, as a sentence.
  bool has_goal = true;    ///< False: the scene gives none, and `goal` is the start.
  /// What was changed of start and goal, and which joints that stay where they are are out of their
  /// limits: a sentence each.
  std::vector<std::string> warnings;
  std::shared_ptr<const geometric::CollisionChecker> checker;  ///< To clone, one per thread.
  std::shared_ptr<const geometric::MotionBound> motion;

  [[nodiscard]] const geometric::RobotModel& model() const { return *scene->robots.front().model; }
  /// Whether the goal is given by poses.
  [[nodiscard]] bool has_pose_goals() const { return !goals.empty() || !goal_fault.empty(); }
  /// Makes `q` the goal, whatever the scene says.
  HANDWAY_PLANNING_EXPORT void set_goal(Configuration q);
};

/// Variables that stay where the start has them, ascending: those that are not `moving`.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<int> fixed_variables(
    const PlanningProblem& problem);

/// Why the goal asks for what does not move, as a sentence; empty if it does not.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string group_fault(const PlanningProblem& problem);

/// What planners move, ascending: arm, hand, and what else moves and the goal has elsewhere than
/// the start.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<int> planned_variables(
    const PlanningProblem& problem);

/// Variables of limbs() that stay where they are, ascending: in a scene without a group, where the
/// goal moves some of a robot's arms or their hands, those of the others. Nothing where the goal
/// moves none. A path that moves them is valid all the same.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<int> resting_variables(
    const geometric::Scene& scene);

/// The hand's variables: of the basis' joints, in its order, or else of the robot's group "hand".
/// Where several parts have such joints, the basis is for the hand that the scene's group lets
/// move, or the goal moves.
/// @param basis may be null. @throws InputError if it names a joint that the robot has not.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<int> hand_variables(
    const geometric::Scene& scene, const sampling::PmdBasis* basis);

/// The arm's: those of the group "arm" or, if none of them moves, of the robot, but for the hand's.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<int> arm_variables(
    const geometric::RobotModel& model, const std::vector<int>& hand);

/// Whether a scene has to say where its robot is to go.
enum class GoalNeed {
  kRequired,
  kOptional,  ///< For what is asked about a path that is there. See PlanningProblem::has_goal.
};

/// Puts a problem together, with hand_variables() and arm_variables(), either of which may be
/// empty. Where the scene has a group, the arm is all of it that is not of the hand, and a hand of
/// which only some joints move has no basis. Without a group resting_variables() are of neither,
/// nor are holding_variables(): a hand that carries something stays as it is, but for joints that
/// the goal has elsewhere. Start and goal are the scene's, a start that is not given is where the
/// robot stands, and the goal has continuous joints within half a turn of the start. A joint of
/// either that is beyond a limit by 1e-5 rad or m or less is taken to be at it. Goal poses are
/// solved by solve_pose_goals().
/// @param basis may be null.
/// @throws InputError if the scene lacks a robot, or a goal that it needs, or the
/// basis names a joint that the robot has not; PreparationStopped where `preparation` asks for it.
[[nodiscard]] HANDWAY_PLANNING_EXPORT PlanningProblem make_problem(
    std::shared_ptr<const geometric::Scene> scene, std::shared_ptr<const sampling::PmdBasis> basis,
    const geometric::Preparation& preparation = {}, GoalNeed need = GoalNeed::kRequired);

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
