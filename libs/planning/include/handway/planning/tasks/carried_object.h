#pragma once

#include "handway/planning/export.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/grasps/hold_test.h"
#include "handway/planning/tasks/task.h"
#include "handway/planning/timing/timing_settings.h"

#include <cstddef>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::planning {

/// The robot at a moment of a planned task.
struct TaskMoment {
  std::size_t stage = 0;  ///< Index into TaskPlan::stages.
  Configuration q;
};

/// What a hand does with an object from the grasp until it opens again: input of
/// HoldTest::carry().
struct CarriedObjectMotion {
  std::string object;
  SceneState before;  ///< The scene in which the hand closes: the object is free.
  int palm = -1;      ///< Link that carries the object.
  Pregrasp grasp;     ///< With closed and squeezed alone.
  PalmMotion motion;
  std::vector<TaskMoment> moments;  ///< At the poses of `motion`; the joints of the hand rest.
};

/// Makes the test that simulates the object in the hand, in the scene before it was grasped.
/// @throws InputError if hand or object can't be simulated; geometric::PreparationStopped if `stop`
/// is requested meanwhile.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::unique_ptr<HoldTest> make_hold_test(
    const CarriedObjectMotion& carried, MakeHoldTest make, const std::stop_token& stop = {});

/// Returns a moment of HoldTest::carry(), which is seen from the palm, as it is seen in the world:
/// the arm moves along the motion.
[[nodiscard]] HANDWAY_PLANNING_EXPORT HoldFrame seen_in_world(const CarriedObjectMotion& carried,
                                                              HoldFrame frame);

/// Returns the index into TaskPlan::stages at a moment of HoldTest::carry(); during the squeeze
/// that of the first stage that carries the object.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::size_t stage_at(const CarriedObjectMotion& carried,
                                                           const HoldFrame& frame);

/// Returns the motion of each object that a planned task carries. The robot rests between stages.
/// @param timing of the stages.
/// @throws InputError if a stage does not pass the pre-flight check at this timing.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<CarriedObjectMotion> carried_motions(
    const TaskPlan& plan, const TimingSettings& timing, const std::stop_token& stop = {});

/// Returns the motion of an object that is attached to the hand along a path of the scene. The
/// grasp is measured at the path's beginning.
/// @param state its scene has one object attached to the first robot.
/// @throws InputError if it has none or several, if fewer than two fingers touch the object, and as
/// carried_motions().
[[nodiscard]] HANDWAY_PLANNING_EXPORT CarriedObjectMotion
carried_motion(const SceneState& state, const Path& path, const TimingSettings& timing,
               const std::stop_token& stop = {});

}  // namespace handway::planning
