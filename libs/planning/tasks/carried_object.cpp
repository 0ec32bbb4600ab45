#include "handway/planning/tasks/carried_object.h"

#include "grasps/measured_grasp.h"
#include "handway/geometric/io/input_error.h"
#include "handway/planning/core/carried_objects.h"
#include "handway/planning/edits/arranging.h"
#include "handway/planning/edits/scene_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace handway::planning {
namespace {

using geometric::Pose;

// Adds the palm's poses along a timed path. @param stage of the path in its plan.
void append_poses(const TimedPath& timed, const Pose& X_WB, std::size_t stage,
                  CarriedObjectMotion& carried) {
  const geometric::RobotModel& model = *timed.motion.model;
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  for (const TrajectoryPoint& point :
       with_rests_sampled(timed.motion.trajectory, carried.motion.period).points) {
    model.forward_kinematics(point.position, X_BL);
    carried.motion.X_WP.push_back(X_WB * X_BL[static_cast<std::size_t>(carried.palm)]);
    carried.moments.push_back({stage, point.position});
  }
}

// @throws InputError if it may not run.
TimedPath cleared(TimedPath timed, const std::string& name) {
  if (!timed.cleared()) {
    throw geometric::InputError(
        {name, "", timed.blends.fault.empty() ? to_text(timed.preflight) : timed.blends.fault,
         "a motion that passes the pre-flight check", ""});
  }
  return timed;
}

TimingOptions options_for(const TimingSettings& timing, const geometric::RobotModel& model,
                          const std::stop_token& stop) {
  TimingOptions options = timing_options(timing, model);
  options.period = PalmMotion{}.period;
  options.stop = stop;
  return options;
}

int palm_link(const geometric::Scene& scene, const std::string& object) {
  const geometric::SceneObject& carried = *geometric::find_object(scene, object);
  return *scene.robots.front().model->find_link(carried.attachment->link);
}

// Index of the pose of the motion at a moment of HoldTest::carry().
std::size_t pose_at(const CarriedObjectMotion& carried, const HoldFrame& frame) {
  if (frame.load == 0) {
    return 0;
  }
  const auto index = static_cast<std::size_t>(std::lround(frame.time / carried.motion.period));
  return std::min(index, carried.moments.size() - 1);
}

}  // namespace

std::unique_ptr<HoldTest> make_hold_test(const CarriedObjectMotion& carried, MakeHoldTest make,
                                         const std::stop_token& stop) {
  const PlanningProblem problem =
      make_problem(carried.before.scene, carried.before.basis, {stop}, GoalNeed::kOptional);
  return make(problem, carried.object, carried.palm);
}

HoldFrame seen_in_world(const CarriedObjectMotion& carried, HoldFrame frame) {
  const std::size_t index = pose_at(carried, frame);
  const std::vector<Pose>& X_WP = carried.motion.X_WP;
  const Pose moved = X_WP[index] * X_WP.front().inverse();
  frame.q += carried.moments[index].q - carried.moments.front().q;
  frame.X_WO = moved * frame.X_WO;
  for (ContactForce& force : frame.forces) {
    force = {moved * force.p_W, moved.linear() * force.f_W};
  }
  return frame;
}

std::size_t stage_at(const CarriedObjectMotion& carried, const HoldFrame& frame) {
  return carried.moments[pose_at(carried, frame)].stage;
}

std::vector<CarriedObjectMotion> carried_motions(const TaskPlan& plan, const TimingSettings& timing,
                                                 const std::stop_token& stop) {
  std::vector<CarriedObjectMotion> motions;
  const TaskStage* close = nullptr;
  for (std::size_t i = 0; i < plan.stages.size(); ++i) {
    const TaskStage& stage = plan.stages[i];
    if (stage.kind == StageKind::kClose) {
      close = &stage;
      continue;
    }
    if (stage.carried.empty() || close == nullptr) {
      close = nullptr;
      continue;
    }
    const geometric::RobotInstance& robot = stage.state.scene->robots.front();
    if (motions.empty() || motions.back().object != stage.carried ||
        motions.back().before.scene != close->state.scene) {
      CarriedObjectMotion& begun = motions.emplace_back();
      begun.object = stage.carried;
      begun.before = close->state;
      begun.palm = palm_link(*stage.state.scene, stage.carried);
      begun.grasp.q = close->path.waypoints.front();
      begun.grasp.closed = close->path.waypoints.back();
      begun.grasp.squeezed = close->squeezed;
    }
    append_poses(
        cleared(time_stage(stage, to_string(stage.kind), options_for(timing, *robot.model, stop)),
                to_string(stage.kind)),
        robot.X_WB, i, motions.back());
  }
  return motions;
}

CarriedObjectMotion carried_motion(const SceneState& state, const Path& path,
                                   const TimingSettings& timing, const std::stop_token& stop) {
  const geometric::Scene& scene = *state.scene;
  const std::vector<CarriedObject> carried = carried_objects(scene);
  if (carried.size() != 1) {
    throw geometric::InputError({source_of(scene), "objects",
                                 fmt::format("{} objects attached to the robot", carried.size()),
                                 "one that the hand carries", ""});
  }
  const PlanningProblem problem =
      make_problem(state.scene, state.basis, {stop}, GoalNeed::kOptional);
  const Configuration& q = path.waypoints.front();
  CarriedObjectMotion motion;
  motion.object = carried.front().name;
  motion.palm = palm_link(scene, motion.object);
  append_poses(
      cleared(time_path(problem, path, "path", options_for(timing, problem.model(), stop)), "path"),
      scene.robots.front().X_WB, 0, motion);
  motion.before = detached(state, q, {motion.object});
  motion.grasp = measured_grasp(motion.before, motion.object, q, stop);
  return motion;
}

}  // namespace handway::planning
