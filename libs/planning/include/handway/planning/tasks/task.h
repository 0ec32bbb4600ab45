#pragma once

#include "handway/geometric/io/parameter.h"
#include "handway/geometric/scene/program.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/export.h"
#include "handway/planning/grasps/given_grasps.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/timing/time_path.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <variant>
#include <vector>

/// @file
/// Tasks: programs of steps such as "pick the can", "place it on the shelf", which are planned as
/// one motion. Each step becomes stages, and each stage has a path in a scene of its own: with the
/// object that the hand carries there, and the contacts that are allowed there. Where a step has
/// alternatives, the plan has stages of one of them.

namespace handway::planning {

using geometric::LineStep;
using geometric::OutputStep;
using geometric::PickStep;
using geometric::PlaceStep;
using geometric::PoseStep;
using geometric::WaitStep;

/// A step that moves to a posture.
struct MoveStep {
  Configuration q;   ///< Shape [variable_count]. While an object is carried the hand stays.
  std::string name;  ///< For messages.
};

/// A step that is one of several lists of steps: the first that is possible. The lists are the next
/// steps of the task, one list after another.
struct FirstOfStep {
  std::vector<std::size_t> lengths;  ///< Number of the steps in each list.
  std::string words;                 ///< For messages.
};

/// A step of a task.
using TaskStep = std::variant<PickStep, PlaceStep, MoveStep, PoseStep, LineStep, WaitStep,
                              OutputStep, FirstOfStep>;

/// Steps in their order.
using Task = std::vector<TaskStep>;

/// Grasps of objects, by the names of the objects.
using GraspsByObject = std::map<std::string, std::vector<GivenGrasp>>;

/// Options of plan_task().
struct TaskOptions {
  std::uint64_t seed = 1;
  int threads = 1;             ///< The result does not depend on it.
  double motion_time_s = 5.0;  ///< Time limit of one motion of the planner, s.
  int places = 24;             ///< Places on a support to try for each grasp.
  /// The search for grasps: its seed and threads are those above. Four grasps with an epsilon of
  /// 0.1 N or more are tried as soon as they are found, before it looks for more.
  PregraspOptions grasps = {.most = 16};
  /// Grasps to try before those that the scene keeps for their objects, and before a search: those
  /// of an earlier plan (grasps_of()), once an object was moved.
  GraspsByObject first_grasps = {};
};

/// Describes the options that users choose, but seed and threads.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<geometric::BoundParameter> parameters_of(
    TaskOptions& options);

/// Kind of a stage.
enum class StageKind {
  kMove,      ///< To a posture or a pose, by the planner.
  kApproach,  ///< To the begin of the reach, by the planner.
  kReach,     ///< Straight to the pre-grasp; at its end the fingers close until near contact.
  kClose,     ///< Until the fingers touch the object.
  kLift,      ///< Straight upwards, with the object.
  kCarry,     ///< With the object, by the planner.
  kLower,     ///< Straight downwards, with the object.
  kOpen,      ///< Until the fingers have left the object.
  kRetreat,   ///< Straight away from the object.
  kLine,      ///< Straight, as a LineStep says.
  kWait,      ///< The robot rests, for the time of a WaitStep.
  kOutput,    ///< An output is set; nothing moves, and no time passes.
};

/// Word for display: "approach", ….
[[nodiscard]] HANDWAY_PLANNING_EXPORT const char* to_string(StageKind kind);

/// A planned stage.
struct TaskStage {
  StageKind kind = StageKind::kMove;
  std::size_t step = 0;  ///< Index into the task.
  /// The scene of the stage. Its start and goal are the ends of the path; objects that the hand
  /// carries are attached; contacts that the stage allows are in its allowed collisions.
  SceneState state;
  Path path;
  std::string carried;     ///< The object that the hand carries; empty: none.
  double deviation = 0.0;  ///< m: bound of the palm's distance from the line, of a straight stage.
  double rest = 0.0;       ///< s: time of a StageKind::kWait.
  /// Joint targets with which the hand holds the object (Pregrasp::squeezed), of StageKind::kClose;
  /// else of size 0.
  Configuration squeezed = {};
  std::optional<GivenGrasp> grasp = {};  ///< The grasp with which a StageKind::kClose ends.
};

/// Counts of the candidates that were tried for one kind of stage in one step.
struct StageTrials {
  std::size_t step = 0;
  StageKind kind = StageKind::kMove;
  int tried = 0;
  int failed = 0;
  std::string reason = {};  ///< Why the first one failed, a sentence without its end.
  Configuration q = {};     ///< A configuration that shows it; of size 0: none.
};

/// Result of planning a task.
struct TaskPlan {
  bool solved = false;
  bool start_is_valid = true;       ///< False: the start is in collision or out of limits.
  std::string reason;               ///< One sentence for display.
  std::vector<TaskStage> stages;    ///< In their order; empty if the task is not solved.
  std::vector<StageTrials> trials;  ///< In the order in which stages were first tried.
  double time_s = 0.0;              ///< Wall clock.
};

/// Plans all steps of a task. Grasps and places are candidates, in the order of their rank. The
/// straight and closing stages of one candidate for each step are found first, the last step's
/// candidates varying fastest; then the planner finds the motions between. Where a motion fails,
/// the search goes on with the next candidate of the step that it belongs to. Every stage is
/// certified along its whole length in its scene. Same arguments, same result, for any number of
/// threads, as long as no motion reaches its time limit.
/// @param state its scene's start is where the task begins; its goal is not used.
/// @param planner of the motions that are not straight.
/// @param stop ends the search soon, with what is known.
/// @throws InputError for steps that can't follow each other, objects and supports that the scene
/// lacks, and a robot without a hand.
[[nodiscard]] HANDWAY_PLANNING_EXPORT TaskPlan plan_task(const SceneState& state, const Task& task,
                                                         Planner& planner,
                                                         const TaskOptions& options = {},
                                                         const std::stop_token& stop = {});

/// Returns whether nothing moves in stages of this kind.
[[nodiscard]] HANDWAY_PLANNING_EXPORT bool is_at_rest(StageKind kind);

/// Times the path of a stage in the scene of the stage. The trajectory of a StageKind::kWait has
/// the two points of its ends, a whole number of periods apart, that of a StageKind::kOutput has
/// one.
/// @param name of the motion, see Motion::name.
[[nodiscard]] HANDWAY_PLANNING_EXPORT TimedPath time_stage(const TaskStage& stage,
                                                           const std::string& name,
                                                           const TimingOptions& options = {});

/// Returns the names of the objects that a task picks, each once, in their order.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<std::string> picked_objects(const Task& task);

/// Returns the grasps with which a plan of `task` picks its objects, to be tried first when the
/// task is planned again (TaskOptions::first_grasps).
[[nodiscard]] HANDWAY_PLANNING_EXPORT GraspsByObject grasps_of(const Task& task,
                                                               const TaskPlan& plan);

/// Words for a step: "pick can", "place on shelf", "move to home".
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string to_string(const TaskStep& step);

}  // namespace handway::planning
