#include "features/tasks/task_film.h"

#include "handway/geometric/setup/placing.h"
#include "widgets/panels/film_bar.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace handway::gui {
namespace {

bool is_carried(const FilmedTask& task, const TaskFrame& frame) {
  return !task.plan.stages[frame.moment.stage].carried.empty();
}

// The planned frames before the object is carried.
std::vector<TaskFrame> frames_before(const FilmedTask& task) {
  const auto end = std::ranges::find_if(
      task.frames, [&](const TaskFrame& frame) { return is_carried(task, frame); });
  return {task.frames.begin(), end};
}

// The planned frames after the object was carried.
std::vector<TaskFrame> frames_after(const FilmedTask& task) {
  const auto begin =
      std::find_if(task.frames.rbegin(), task.frames.rend(), [&](const TaskFrame& frame) {
        return is_carried(task, frame);
      }).base();
  return {begin, task.frames.end()};
}

}  // namespace

void add_film(FilmedTask& task, const std::stop_token& stop) {
  if (!task.plan.solved) {
    return;
  }
  planning::TimingOptions options =
      timing_options(task.timing, *task.plan.stages.front().state.scene->robots.front().model);
  options.period = FilmBar::kFrameTimeMs / 1000.0;
  options.stop = stop;
  const planning::TimedTask timed = time_task(task.task, task.plan, "task", options);
  for (std::size_t i = 0; i < timed.stages.size(); ++i) {
    const planning::TimedPath& stage = timed.stages[i];
    const planning::TaskStage& planned = task.plan.stages[i];
    if (!stage.cleared()) {
      task.plan.solved = false;
      task.plan.reason = to_text(stage.preflight);
      return;
    }
    task.stages.push_back({planned.kind, stage.preflight.duration, stage.preflight.min_clearance,
                           QString::fromStdString(stage.preflight.closest_pair)});
    const geometric::SceneObject& moved = *planned.state.find(task.object);
    for (const planning::TrajectoryPoint& point : stage.motion.trajectory.points) {
      task.frames.push_back(
          {{i, point.position}, object_pose(*planned.state.scene, point.position, moved)});
    }
  }
}

SimulatedTask simulate(const FilmedTask& task, planning::MakeHoldTest make_test,
                       const planning::HoldConditions& conditions, const std::stop_token& stop) {
  SimulatedTask simulated;
  simulated.frames = frames_before(task);
  for (const planning::CarriedObjectMotion& carried :
       carried_motions(task.plan, task.timing, stop)) {
    const auto test = make_hold_test(carried, make_test, stop);
    simulated.result = test->carry(
        carried.grasp, carried.motion, conditions, stop, [&](const planning::HoldFrame& frame) {
          planning::HoldFrame seen = seen_in_world(carried, frame);
          simulated.frames.push_back(
              {{stage_at(carried, frame), std::move(seen.q)}, seen.X_WO, std::move(seen.forces)});
        });
  }
  if (simulated.result.held()) {
    const geometric::Pose X_WO = simulated.frames.back().X_WO;  // where the object has slipped to
    for (TaskFrame& frame : frames_after(task)) {
      frame.X_WO = X_WO;
      simulated.frames.push_back(std::move(frame));
    }
  }
  return simulated;
}

}  // namespace handway::gui
