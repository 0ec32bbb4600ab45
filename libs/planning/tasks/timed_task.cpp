#include "handway/planning/tasks/timed_task.h"

#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/planning/core/plan_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>

namespace handway::planning {
namespace {

// Adds the joints of `more` that `joints` lacks, and keeps both in the order of the configuration.
void add_joints(geometric::JointIndices& joints, const geometric::JointIndices& more) {
  joints.insert(joints.end(), more.begin(), more.end());
  std::ranges::sort(joints);
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
}

MotionStage mark_of(const Task& task, const TaskStage& stage, const std::string& carried) {
  MotionStage mark;
  mark.name = to_string(stage.kind);
  mark.step = to_string(task[stage.step]);
  mark.squeezed = stage.squeezed;
  if (stage.kind == StageKind::kClose) {
    mark.hand = HandAction::kClose;
    if (const auto* pick = std::get_if<PickStep>(&task[stage.step])) {
      mark.object = pick->object;
    }
  } else if (stage.kind == StageKind::kOpen) {
    mark.hand = HandAction::kOpen;
    mark.object = carried;
  }
  mark.waits = stage.kind == StageKind::kWait;
  if (const auto* output = std::get_if<OutputStep>(&task[stage.step])) {
    mark.output = *output;
  }
  return mark;
}

// Appends a motion that begins where `all` ends.
void append(const Motion& next, MotionStage mark, Motion& all) {
  std::vector<Configuration>& waypoints = all.path.waypoints;
  const double begin = all.trajectory.empty() ? 0.0 : all.trajectory.points.back().time;
  const std::size_t common = waypoints.empty() ? 0 : 1;  // the end of the stage before
  mark.first = waypoints.empty() ? 0 : waypoints.size() - 1;
  const std::size_t added = mark.output ? 1 : next.path.waypoints.size();
  for (std::size_t w = common; w < added; ++w) {
    waypoints.push_back(next.path.waypoints[w]);
    all.waypoint_times.push_back(begin + next.waypoint_times[w]);
  }
  for (std::size_t i = common; i < next.trajectory.points.size(); ++i) {
    all.trajectory.points.push_back(next.trajectory.points[i]);
    all.trajectory.points.back().time += begin;
  }
  all.stages.push_back(std::move(mark));
}

// @param period s, of a motion in which nothing takes time.
Motion joined(const Task& task, const TaskPlan& plan, const std::vector<TimedPath>& stages,
              const std::string& name, double period) {
  Motion all = stages.front().motion;
  all.name = name;
  all.path.waypoints.clear();
  all.waypoint_times.clear();
  all.trajectory.points.clear();
  std::string carried;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const Motion& next = stages[i].motion;
    add_joints(all.arm, next.arm);
    add_joints(all.hand, next.hand);
    append(next, mark_of(task, plan.stages[i], carried), all);
    carried = plan.stages[i].carried;
  }
  if (all.path.waypoints.size() == 1) {  // outputs alone: a motion has an end
    all.path.waypoints.push_back(all.path.waypoints.front());
    all.waypoint_times.push_back(period);
    all.trajectory.points.push_back(all.trajectory.points.front());
    all.trajectory.points.back().time = period;
  }
  return all;
}

void keep_larger(LimitShare share, double begin, LimitShare& largest) {
  if (share.share > largest.share) {
    share.time += begin;
    largest = std::move(share);
  }
}

void keep_worse(const std::optional<ClearanceShortfall>& shortfall, double begin,
                std::optional<ClearanceShortfall>& worst) {
  const auto lacking = [](const ClearanceShortfall& s) { return s.needed() - s.clearance; };
  if (shortfall && (!worst || lacking(*shortfall) > lacking(*worst))) {
    worst = shortfall;
    worst->place += begin;
  }
}

// Adds the report of a stage that begins at `begin` (s).
void merge(const PreflightReport& stage, double begin, PreflightReport& all) {
  for (TrajectoryFault fault : stage.faults) {
    fault.time += begin;
    all.faults.push_back(std::move(fault));
  }
  for (const std::string& warning : stage.warnings) {
    if (std::ranges::count(all.warnings, warning) == 0) {
      all.warnings.push_back(warning);
    }
  }
  keep_larger(stage.velocity, begin, all.velocity);
  keep_larger(stage.acceleration, begin, all.acceleration);
  if (stage.min_clearance < all.min_clearance) {
    all.min_clearance = stage.min_clearance;
    all.min_clearance_time = begin + stage.min_clearance_time;
    all.closest_pair = stage.closest_pair;
  }
  keep_worse(stage.shortfall, begin, all.shortfall);
  all.assumed_following_error |= stage.assumed_following_error;
}

void merge(const BlendResult& stage, BlendResult& all) {
  all.fault = all.fault.empty() ? stage.fault : all.fault;
  all.arcs += stage.arcs;
  all.reduced += stage.reduced;
  all.stops += stage.stops;
  all.largest_deviation = std::max(all.largest_deviation, stage.largest_deviation);
}

}  // namespace

bool TimedTask::cleared() const {
  return !stages.empty() && std::ranges::all_of(stages, &TimedPath::cleared);
}

TimedTask time_task(const Task& task, const TaskPlan& plan, const std::string& name,
                    const TimingOptions& options) {
  TimedTask timed;
  TimingOptions of_stage = options;
  for (std::size_t i = 0; i < plan.stages.size(); ++i) {
    geometric::end_if_stopped(options.stop);
    const TaskStage& stage = plan.stages[i];
    timed.stages.push_back(time_stage(
        stage, motion_name(fmt::format("{:02}-{}", i + 1, to_string(stage.kind))), of_stage));
    of_stage.measured_start.resize(0);
  }
  if (timed.cleared()) {
    timed.motion = joined(task, plan, timed.stages, name, options.period);
  }
  return timed;
}

std::span<const TrajectoryPoint> points_of_stage(const Motion& motion, std::size_t stage) {
  constexpr double kRounding = 1e-9;  // s
  const std::vector<TrajectoryPoint>& points = motion.trajectory.points;
  const auto at = [&](double time) {
    return std::ranges::lower_bound(points, time - kRounding, {}, &TrajectoryPoint::time);
  };
  const auto begin = at(motion.waypoint_times[motion.stages[stage].first]);
  const bool is_last = stage + 1 == motion.stages.size();
  const auto last =
      is_last ? points.end() - 1 : at(motion.waypoint_times[motion.stages[stage + 1].first]);
  return {begin, last + 1};
}

TimedPath whole_task(const TimedTask& task) {
  TimedPath whole;
  whole.motion = task.motion;
  whole.preflight.points = task.motion.trajectory.points.size();
  whole.preflight.min_clearance = kFarClearance;
  double begin = 0.0;
  for (const TimedPath& stage : task.stages) {
    whole.preflight.assumed = stage.preflight.assumed;
    merge(stage.preflight, begin, whole.preflight);
    merge(stage.blends, whole.blends);
    whole.least_duration += stage.least_duration;
    begin += stage.preflight.duration;
  }
  whole.preflight.duration = begin;
  if (task.cleared()) {
    whole.blends.stops +=
        static_cast<int>(std::ranges::count_if(
            task.motion.stages,
            [](const MotionStage& stage) { return !stage.waits && !stage.output; })) -
        1;
    whole.blends.stops = std::max(0, whole.blends.stops);
    whole.blends.path.emplace(task.motion.path,
                              std::vector<double>(task.motion.path.waypoints.size(), 0.0));
  }
  return whole;
}

}  // namespace handway::planning
