#include "model/playback/motion_curves.h"

#include "handway/planning/queries/human_likeness.h"
#include "handway/planning/timing/certified_blends.h"
#include "handway/planning/timing/time_law.h"

#include <algorithm>

namespace handway::gui {
namespace {

constexpr double kPeriod = 0.01;  // s

}  // namespace

PathMotion motion_of(const planning::PlanningProblem& problem, const planning::Path& path) {
  auto motion = std::make_shared<planning::Motion>();
  motion->name = "path";
  motion->model = problem.scene->robots.front().model;
  motion->arm = problem.arm;
  motion->hand = problem.hand;
  motion->limits = planning::rate_limits(problem.model());
  motion->limits.jerk.resize(0);
  motion->path = path;
  const planning::BlendResult blends = planning::certified_blends(problem, path);
  if (!blends.path) {
    return {nullptr, blends.fault};
  }
  const planning::TimeLaw law = planning::time_optimal(*blends.path, motion->limits);
  motion->waypoint_times = planning::waypoint_times(*blends.path, law);
  motion->trajectory = planning::sample(*blends.path, law, kPeriod);
  return {motion, {}};
}

MotionCurves hand_curves(const planning::PlanningProblem& problem,
                         const std::shared_ptr<const sampling::RecordedPostures>& postures,
                         const planning::Trajectory& trajectory, const std::stop_token& stop) {
  MotionCurves curves;
  if (!problem.basis) {
    return curves;
  }
  const planning::HumanLikeness likeness(problem.model(), problem.hand, *problem.basis, postures);
  for (const planning::TrajectoryPoint& point : trajectory.points) {
    if (stop.stop_requested()) {
      break;
    }
    const planning::HandLikeness here = likeness.at(point.position);
    curves.to_subspace.push_back(here.to_subspace);
    if (here.to_recorded) {
      curves.to_recorded.push_back(*here.to_recorded);
    }
  }
  return curves;
}

MotionCurves motion_curves(const planning::PlanningProblem& problem,
                           const std::shared_ptr<const sampling::RecordedPostures>& postures,
                           const planning::Trajectory& trajectory, const std::stop_token& stop) {
  MotionCurves curves = hand_curves(problem, postures, trajectory, stop);
  const std::unique_ptr<geometric::CollisionChecker> checker = problem.checker->clone();
  for (const planning::TrajectoryPoint& point : trajectory.points) {
    if (stop.stop_requested()) {
      break;
    }
    const geometric::NamedPair closest =
        geometric::find_clearance(*checker, point.position, kMostClearance);
    const bool is_near = closest.distance < kMostClearance;
    curves.clearance.push_back(std::min(closest.distance, kMostClearance));
    curves.closest.push_back(is_near ? closest.a + " with " + closest.b : std::string());
  }
  return curves;
}

}  // namespace handway::gui
