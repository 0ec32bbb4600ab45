#include "features/tasks/task_film.h"

#include "handway/geometric/setup/placing.h"
#include "widgets/panels/film_bar.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace handway::gui {
namespace {

// Points of a timed stage, one for each frame. A film doesn't wait longer than a minute.
planning::Trajectory shown_points(const planning::TaskStage& stage, planning::Trajectory trajectory,
                                  double period) {
  constexpr double kLongestShownWait = 60.0;  // s
  if (stage.kind == planning::StageKind::kWait) {
    trajectory.points.back().time = std::min(trajectory.points.back().time, kLongestShownWait);
  }
  return with_rests_sampled(trajectory, period);
}

// Adds the planned frames from one on, with some objects where a simulation has left them, to the
// first in which the hand carries `object`. @returns the index of that frame.
std::size_t add_until_carried(const FilmedTask& task, std::size_t begin, const std::string& object,
                              const std::map<std::size_t, geometric::Pose>& left,
                              std::vector<TaskFrame>& frames) {
  for (; begin < task.frames.size(); ++begin) {
    TaskFrame frame = task.frames[begin];
    if (!object.empty() && task.plan.stages[frame.moment.stage].carried == object) {
      break;
    }
    for (const auto& [index, X_WO] : left) {
      frame.X_WO[index] = X_WO;
    }
    frames.push_back(std::move(frame));
  }
  return begin;
}

// The first frame from `begin` on in which the hand does not carry `object`.
std::size_t end_of_carrying(const FilmedTask& task, std::size_t begin, const std::string& object) {
  while (begin < task.frames.size() &&
         task.plan.stages[task.frames[begin].moment.stage].carried == object) {
    ++begin;
  }
  return begin;
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
    for (const planning::TrajectoryPoint& point :
         shown_points(planned, stage.motion.trajectory, options.period).points) {
      TaskFrame frame{{i, point.position}, {}};
      for (const std::string& object : task.objects) {
        frame.X_WO.push_back(
            object_pose(*planned.state.scene, point.position, *planned.state.find(object)));
      }
      task.frames.push_back(std::move(frame));
    }
  }
}

SimulatedTask simulate(const FilmedTask& task, planning::MakeHoldTest make_test,
                       const planning::HoldConditions& conditions, const std::stop_token& stop) {
  SimulatedTask simulated;
  std::map<std::size_t, geometric::Pose> left;  // where objects have slipped to
  std::size_t next = 0;                         // planned frame
  bool is_first = true;
  for (const planning::CarriedObjectMotion& carried :
       carried_motions(task.plan, task.timing, stop)) {
    next = add_until_carried(task, next, carried.object, left, simulated.frames);
    const auto index = static_cast<std::size_t>(std::ranges::find(task.objects, carried.object) -
                                                task.objects.begin());
    std::vector<geometric::Pose> X_WO = simulated.frames.back().X_WO;
    const auto test = make_hold_test(carried, make_test, stop);
    const planning::CarryResult result = test->carry(
        carried.grasp, carried.motion, conditions, stop, [&](const planning::HoldFrame& frame) {
          planning::HoldFrame seen = seen_in_world(carried, frame);
          X_WO[index] = seen.X_WO;
          simulated.frames.push_back(
              {{stage_at(carried, frame), std::move(seen.q)}, X_WO, std::move(seen.forces)});
        });
    if (is_first || !result.held() || result.slip.shift > simulated.result.slip.shift) {
      simulated.result = result;
    }
    if (!result.held()) {
      return simulated;
    }
    is_first = false;
    left[index] = X_WO[index];
    next = end_of_carrying(task, next, carried.object);
  }
  add_until_carried(task, next, {}, left, simulated.frames);
  return simulated;
}

}  // namespace handway::gui
