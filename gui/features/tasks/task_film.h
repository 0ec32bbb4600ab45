#pragma once

#include "features/tasks/task_card.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/grasps/hold_test.h"
#include "handway/planning/tasks/carried_object.h"
#include "handway/planning/tasks/timed_task.h"
#include "handway/planning/timing/timing_settings.h"

#include <stop_token>
#include <string>
#include <vector>

namespace handway::gui {

/// A moment of a task, as it is shown.
struct TaskFrame {
  planning::TaskMoment moment;
  std::vector<geometric::Pose> X_WO;                ///< Poses of FilmedTask::objects.
  std::vector<planning::ContactForce> forces = {};  ///< The hand's forces on it, in a simulation.
};

/// A planned task, with all that is shown of it.
struct FilmedTask {
  std::vector<std::string> objects;  ///< Picked objects, each once.
  planning::Task task;
  planning::TaskPlan plan;
  planning::TimingSettings timing;
  std::vector<ShownStage> stages;
  std::vector<TaskFrame> frames;  ///< One every FilmBar::kFrameTimeMs.
};

/// A task in which the hand carries its objects in a simulation.
struct SimulatedTask {
  planning::CarryResult result;   ///< Result of the object that is lost, or that slips most.
  std::vector<TaskFrame> frames;  ///< They end where an object is lost.
};

/// Times a planned task, and adds what is shown of it: stages and frames, or the fault of the first
/// stage that is not cleared, as the reason why the plan is not solved.
/// @throws geometric::PreparationStopped if a stop is requested.
void add_film(FilmedTask& task, const std::stop_token& stop);

/// Simulates how the hand carries the objects of a solved task.
/// @throws InputError if hand or object can't be simulated.
[[nodiscard]] SimulatedTask simulate(const FilmedTask& task, planning::MakeHoldTest make_test,
                                     const planning::HoldConditions& conditions,
                                     const std::stop_token& stop);

}  // namespace handway::gui
