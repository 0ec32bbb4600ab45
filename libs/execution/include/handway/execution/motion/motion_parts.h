#pragma once

#include "handway/execution/export.h"
#include "handway/execution/motion/motion_run.h"
#include "handway/execution/motion/scene_watch.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/timing/time_path.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace handway::execution {

/// A part of a motion, from rest to rest, in a scene of its own.
struct MotionPart {
  std::string name = {};            ///< For display: "lift (pick can)"; empty: a whole motion.
  planning::Trajectory trajectory;  ///< It has points.
  SceneWatch::ProblemSource scene;  ///< The scene in which this part runs.
  std::size_t stage = 0;            ///< Stage of the motion that it belongs to.
  /// Distance by which an object in the hand may keep each variable from its target, rad or m,
  /// [variable_count]; of size 0: none.
  geometric::Configuration give = {};
  bool rests = false;  ///< The robot rests: the devices get no motion, and time passes.
};

/// Returns the parts of a task's motion, in their order. While the hand carries an object, the
/// targets of its joints are those that squeeze the object (MotionStage::squeezed); an object of
/// the real world keeps the fingers from reaching them. Between the stages, a part `hold` moves the
/// fingers to these targets, and a part `release` moves them back. Stages that set an output have
/// no part, see unset_outputs().
/// @param motion of planning::time_task(). @param scenes those of its stages, shape [stages].
[[nodiscard]] HANDWAY_EXECUTION_EXPORT std::vector<MotionPart> parts_of(
    const planning::Motion& motion, const std::vector<planning::SceneState>& scenes);

/// Returns a sentence that names the outputs which a motion sets, and its devices don't; empty if
/// there are none. No device has outputs.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT std::string unset_outputs(const planning::Motion& motion);

/// Returns the sum of the durations of parts, s.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT double duration_of(std::span<const MotionPart> parts);

/// Runs the parts of a motion one after another, as run_motion(). Times of the outcome and of the
/// observer are from the begin of the first part. A hold that is requested between two parts lasts
/// until it is cleared, and then the next part begins. A part that can't begin is a fault.
/// @param requests their watch watches the first part; null: the scene is not edited.
/// @throws geometric::InputError and DeviceError if the first part can't begin.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT MotionOutcome run_parts(
    std::vector<MotionTarget>& targets, const std::vector<MotionPart>& parts,
    const device::MotionTolerances& tolerances, MotionRequests& requests, MotionObserver& observer);

}  // namespace handway::execution
