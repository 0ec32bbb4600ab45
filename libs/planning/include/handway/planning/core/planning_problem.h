#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/collision/continuous/motion_bound.h"
#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/robot/hand_structure.h"
#include "handway/geometric/robot/joint_selection.h"
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
  std::shared_ptr<const sampling::PmdBasis> basis;  ///< Basis of the hand; null: none.
  geometric::JointSelection joints;  ///< Its arm, hand, moving and fixed joints: select_joints().
  geometric::HandStructure hand;     ///< Palm and fingers of the joints' hand.
  Configuration start;               ///< c_ini
  Configuration goal;                ///< c_goal
  /// Configurations that reach a goal pose of the scene. `goal` is the first, and planners may take
  /// any of them. Empty: `goal` is the only goal.
  std::vector<GoalCandidate> goals;
  std::string goal_fault;  ///< Reason why no configuration reaches a goal pose, as a sentence.
  bool has_goal = true;    ///< False: the scene has no goal, and `goal` is the start.
  /// Warnings about changes to start and goal, and about fixed joints beyond their limits: a
  /// sentence each.
  std::vector<std::string> warnings;
  std::shared_ptr<const geometric::CollisionChecker> checker;  ///< Cloned by each thread.
  std::shared_ptr<const geometric::MotionBound> motion;

  [[nodiscard]] const geometric::RobotModel& model() const { return *scene->robots.front().model; }
  /// Returns whether the goal is given by poses.
  [[nodiscard]] bool has_pose_goals() const { return !goals.empty() || !goal_fault.empty(); }
  /// Returns the joints that a plan of this problem moves, ascending: those of arm and hand, and
  /// others that may move and whose goal differs from the start.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::JointIndices planned_joints() const;
  /// Makes `q` the only goal, instead of the scene's.
  HANDWAY_PLANNING_EXPORT void set_goal(Configuration q);
};

/// Returns a sentence that names the fixed joints that the goal moves; empty if it moves none.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string group_fault(const PlanningProblem& problem);

/// Requirement that a scene has a goal for its robot.
enum class GoalNeed {
  kRequired,
  kOptional,  ///< Suffices for checking and timing a given path; see PlanningProblem::has_goal.
};

/// Builds a problem of the joints of select_joints(); arm and hand may be empty. If some joints of
/// the hand are fixed or hold an object, the problem has no basis. Start and goal are
/// the scene's; the default start is the robot's configuration. Continuous joints of the goal are
/// within half a turn of the start. A joint of start or goal that exceeds a limit by at most 1e-5
/// rad or m is set to the limit. Goal poses are solved by solve_pose_goals().
///
/// @param basis may be null.
/// @throws InputError if the scene lacks a robot, or a goal that it needs, or the
/// basis names a joint that the robot lacks; PreparationStopped if `preparation` is stopped.
[[nodiscard]] HANDWAY_PLANNING_EXPORT PlanningProblem make_problem(
    std::shared_ptr<const geometric::Scene> scene, std::shared_ptr<const sampling::PmdBasis> basis,
    const geometric::Preparation& preparation = {}, GoalNeed need = GoalNeed::kRequired);

/// Builds the problem of a changed scene as make_problem(), and reuses all that the change leaves
/// valid in `before`: the checker, or at least the meshes that it has prepared.
/// @throws as make_problem().
[[nodiscard]] HANDWAY_PLANNING_EXPORT PlanningProblem
updated_problem(const PlanningProblem& before, std::shared_ptr<const geometric::Scene> scene,
                std::shared_ptr<const sampling::PmdBasis> basis,
                const geometric::Preparation& preparation = {});

/// Returns the distance of two configurations in joints normalised to [0, 1] (paper, section 7).
[[nodiscard]] HANDWAY_PLANNING_EXPORT double normalised_distance(const geometric::RobotModel& model,
                                                                 const Configuration& a,
                                                                 const Configuration& b);

/// Returns the arm's progress on its straight motion from start to goal, in [0, 1]: that of the
/// nearest configuration on it; 0 if start and goal of the arm are the same.
[[nodiscard]] HANDWAY_PLANNING_EXPORT double arm_progress(const PlanningProblem& problem,
                                                          const Configuration& q);

}  // namespace handway::planning
