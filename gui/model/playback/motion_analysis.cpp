#include "model/playback/motion_analysis.h"

#include "handway/planning/queries/human_likeness.h"
#include "handway/planning/timing/blended_path.h"
#include "handway/planning/timing/time_parameterization.h"
#include "model/document/document.h"
#include "model/playback/path_player.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace handway::gui {
namespace {

constexpr double kPeriod = 0.01;  // s

}  // namespace

PathMotion motion_of(const planning::PlanningProblem& problem, const planning::Path& path) {
  auto motion = std::make_shared<planning::Motion>();
  motion->name = "path";
  motion->model = problem.scene->robots.front().model;
  motion->arm = problem.joints.arm;
  motion->hand = problem.joints.hand;
  motion->limits = planning::rate_limits(problem.model());
  motion->limits.jerk.resize(0);
  motion->path = path;
  const planning::BlendResult blends = planning::certified_blends(problem, path);
  if (!blends.path) {
    return {nullptr, blends.fault};
  }
  const planning::TimeParameterization law = planning::time_optimal(*blends.path, motion->limits);
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
  const planning::HumanLikeness likeness(problem.model(), problem.joints.hand, *problem.basis,
                                         postures);
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

namespace {

constexpr int kCalmMs = 120;

}  // namespace

MotionAnalysis::MotionAnalysis(Document& document, PathPlayer& player, QObject* parent)
    : QObject(parent), document_(document), player_(player) {
  calm_.setSingleShot(true);
  calm_.setInterval(kCalmMs);
  connect(&calm_, &QTimer::timeout, this, &MotionAnalysis::time_path);
  connect(&player_, &PathPlayer::timeline_changed, this, &MotionAnalysis::begin);
  connect(&document_, &Document::edited, this, [this](const planning::SceneState& before) {
    if (before.scene != document_.scene()) {
      begin();  // times and clearance are of the scene before
    }
  });
  connect(&document_.recorded_hand(), &RecordedHand::changed, this, [this] {
    if (motion_) {
      find_curves();
    }
  });
}

void MotionAnalysis::begin() {
  job_.cancel();
  motion_.reset();
  problem_.reset();
  curves_.reset();
  fault_.clear();
  const bool has_path = !player_.timeline().empty() && document_.problem();
  state_ = has_path ? State::kTiming : State::kNoPath;
  if (has_path) {
    player_.set_times(PathPlayer::Times::kPending);
    calm_.start();
  } else {
    player_.set_times(PathPlayer::Times::kEstimated);
    calm_.stop();
  }
  emit changed();
}

void MotionAnalysis::time_path() {
  job_.run([this, prepared = document_.problem(),
            path = player_.timeline().path()](const std::stop_token& stop) -> LatestJob::Answer {
    PathMotion timed;
    PreparedProblem::Problem problem;
    try {
      problem = prepared->wait(stop);
      if (!problem) {
        return {};
      }
      timed = motion_of(*problem, path);
    } catch (const std::exception& error) {
      timed.fault = error.what();
    }
    return [this, timed, problem] {
      problem_ = problem;
      take_motion(timed);
      if (timed.motion) {
        find_curves();
      }
    };
  });
}

void MotionAnalysis::take_motion(const PathMotion& timed) {
  motion_ = timed.motion;
  fault_ = QString::fromStdString(timed.fault);
  state_ = motion_ ? State::kTimed : State::kFailed;
  if (motion_) {
    player_.set_motion(motion_);
  } else {
    player_.set_times(PathPlayer::Times::kEstimated);
  }
  emit changed();
}

void MotionAnalysis::find_curves() {
  job_.run([this, problem = problem_, postures = document_.recorded_hand().postures(),
            motion = motion_](const std::stop_token& stop) -> LatestJob::Answer {
    const auto curves = std::make_shared<const MotionCurves>(
        motion_curves(*problem, postures, motion->trajectory, stop));
    return [this, curves] {
      curves_ = curves;
      emit changed();
    };
  });
}

}  // namespace handway::gui
