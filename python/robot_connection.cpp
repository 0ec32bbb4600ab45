#include "robot_connection.h"

#include "handway/device/core/device_error.h"
#include "handway/execution/motion/motion_target.h"

#include <chrono>
#include <utility>

namespace handway::python {
namespace {

using geometric::InputError;

class Silent final : public execution::MotionObserver {
 public:
  void on_sample(const execution::MotionSample& /*sample*/) override {}
  void on_progress(double /*time*/,
                   const std::vector<execution::FollowingError>& /*errors*/) override {}
};

planning::Path path_of(const planning::Trajectory& trajectory) {
  planning::Path path;
  for (const planning::TrajectoryPoint& point : trajectory.points) {
    path.waypoints.push_back(point.position);
  }
  return path;
}

}  // namespace

RobotConnection::RobotConnection(std::shared_ptr<const planning::PlanningProblem> problem,
                                 const std::string& to, const std::stop_token& stop)
    : problem_(std::move(problem)), targets_(execution::parse_targets(to, *problem_)) {
  for (const execution::MotionTarget& target : targets_) {
    target.link->connect(stop);
  }
  listener_ = std::jthread([this](const std::stop_token& end) { listen(end); });
}

RobotConnection::~RobotConnection() { close(); }

void RobotConnection::listen(const std::stop_token& stop) {
  constexpr std::chrono::milliseconds kPause{2};  // in which others get at the devices
  while (!stop.stop_requested()) {
    {
      const std::lock_guard lock(devices_);
      for (const execution::MotionTarget& target : targets_) {
        target.link->update();
      }
    }
    std::this_thread::sleep_for(kPause);
  }
}

void RobotConnection::check_open() const {
  if (targets_.empty()) {
    throw InputError({"the connection", "", "one that was closed", "an open one", "Connect again"});
  }
}

RobotConnection::Outcome RobotConnection::run(const planning::TimedPath& timed,
                                              const device::MotionTolerances& tolerances,
                                              const std::stop_token& stop) {
  if (!timed.cleared()) {
    throw InputError({"the motion", "", "a motion that is not cleared", "one without faults",
                      "Motion.faults says why"});
  }
  if (timed.motion.model != problem_->scene->robots.front().model) {
    throw InputError({"the motion", "", "a motion of another robot", "one of the scene's robot",
                      "Time the path in the scene that the connection was made from"});
  }
  std::stop_source ended;
  {
    const std::lock_guard lock(running_mutex_);
    running_ = ended;
  }
  const std::stop_callback passed_on(stop, [&] { ended.request_stop(); });
  const std::lock_guard lock(devices_);
  check_open();
  const planning::Trajectory& trajectory = timed.motion.trajectory;
  execution::check_that_the_rest_stands(*timed.motion.model, path_of(trajectory), targets_);
  for (const execution::MotionTarget& target : targets_) {
    target.link->update();
    target.link->upload(execution::part_of(trajectory, target.variables), ended.get_token());
  }
  execution::SceneWatch watch(trajectory, [this](const std::stop_token&) { return problem_; });
  execution::MotionRequests requests{.stop = ended.get_token(), .watch = &watch};
  Silent observer;
  Outcome outcome;
  outcome.motion = execution::run_motion(targets_, tolerances, requests, observer);
  for (std::size_t i = 0; i < outcome.motion.errors.size(); ++i) {
    const device::JointRanges& joints = targets_[i].link->joints();
    for (Eigen::Index j = 0; j < joints.count(); ++j) {
      outcome.largest_errors.emplace_back(joints.names[static_cast<std::size_t>(j)],
                                          outcome.motion.errors[i].max()[j]);
    }
  }
  return outcome;
}

void RobotConnection::stop() {
  {
    const std::lock_guard lock(running_mutex_);
    running_.request_stop();
  }
  const std::lock_guard lock(devices_);
  for (const execution::MotionTarget& target : targets_) {
    target.link->stop();
  }
}

void RobotConnection::close() {
  stop();
  listener_ = {};
  const std::lock_guard lock(devices_);
  targets_.clear();
}

geometric::Configuration RobotConnection::measured() {
  const std::lock_guard lock(devices_);
  check_open();
  for (const execution::MotionTarget& target : targets_) {
    if (!target.link->fault().empty()) {
      throw device::DeviceError({target.link->name(), "", target.link->fault(),
                                 "a device that answers", "Connect again"});
    }
  }
  return execution::with_measured(problem_->start, targets_);
}

}  // namespace handway::python
