#pragma once

#include "handway/planning/export.h"
#include "handway/planning/tasks/task.h"
#include "handway/planning/timing/time_path.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace handway::planning {

/// A planned task, timed from its beginning to its end.
struct TimedTask {
  std::vector<TimedPath> stages;  ///< Those of TaskPlan::stages, each checked in its own scene.
  /// All stages one after another, with MotionStage marks; empty unless cleared(). The robot rests
  /// between them.
  Motion motion = {};

  /// Returns whether there are stages, and all of them are cleared.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT bool cleared() const;
};

/// Times every stage of a planned task in the scene of the stage, and joins them into one motion.
/// The motions of the stages are named after their number and kind.
/// @param task that was planned. @param name of the joined motion, see Motion::name.
/// @param options of time_path(), for every stage; the measured start is that of the first one.
/// @throws InputError for options out of their ranges; geometric::PreparationStopped if the
/// options' stop is requested.
[[nodiscard]] HANDWAY_PLANNING_EXPORT TimedTask time_task(const Task& task, const TaskPlan& plan,
                                                          const std::string& name,
                                                          const TimingOptions& options = {});

/// Returns the points of a stage of a motion, both ends included.
/// @pre motion.stages has an element `stage`.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::span<const TrajectoryPoint> points_of_stage(
    const Motion& motion, std::size_t stage);

/// Returns a timed task as one TimedPath, for display: the joined motion, and a report with the
/// faults, the least clearance and the worst shortfall of all stages. Times are those of the task.
[[nodiscard]] HANDWAY_PLANNING_EXPORT TimedPath whole_task(const TimedTask& task);

}  // namespace handway::planning
