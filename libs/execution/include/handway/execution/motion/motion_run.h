#pragma once

#include "handway/execution/export.h"
#include "handway/execution/motion/motion_target.h"
#include "handway/execution/motion/scene_watch.h"

#include <Eigen/Core>

#include <atomic>
#include <cstddef>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::execution {

/// How far a device's joints were from where they should have been; shapes [joints].
class HANDWAY_EXECUTION_EXPORT FollowingError {
 public:
  explicit FollowingError(Eigen::Index joints)
      : max_(Eigen::VectorXd::Zero(joints)), squares_(Eigen::VectorXd::Zero(joints)) {}

  void add(const Eigen::VectorXd& error);
  [[nodiscard]] int samples() const { return samples_; }
  [[nodiscard]] const Eigen::VectorXd& max() const { return max_; }  ///< rad
  [[nodiscard]] Eigen::VectorXd rms() const;                         ///< rad

 private:
  Eigen::VectorXd max_;
  Eigen::VectorXd squares_;
  int samples_ = 0;
};

/// What a device reported of itself while a motion ran.
struct MotionSample {
  double time = 0.0;         ///< s of the motion.
  std::size_t target = 0;    ///< Which device.
  Eigen::VectorXd planned;   ///< rad, [its joints]
  Eigen::VectorXd measured;  ///< rad, [its joints]
};

/// Hears of a motion as it runs, on the thread that runs it. What it throws is a fault: it stops
/// the motion, and the observer is not called again.
class HANDWAY_EXECUTION_EXPORT MotionObserver {
 public:
  virtual ~MotionObserver() = default;
  virtual void on_sample(const MotionSample& sample) = 0;
  /// Every few milliseconds. @param time s of the motion. @param errors of each target so far.
  virtual void on_progress(double time, const std::vector<FollowingError>& errors) = 0;
  /// The scene is why the motion is held: it set MotionRequests::hold. Comes again when the reason
  /// changes; once nothing is in the way, hold can be set to false.
  virtual void on_held(const std::string& /*reason*/) {}
};

/// What others may ask of a motion that runs, from any thread.
struct MotionRequests {
  std::stop_token stop;
  /// Held while true. The run sets it for what its watch finds, and then waits for somebody to
  /// clear it.
  std::atomic<bool> hold = false;
  /// Of this motion; null: nobody edits the scene, and it was checked just now.
  SceneWatch* watch = nullptr;
};

/// How a motion on devices ended.
struct MotionOutcome {
  bool done = false;          ///< To its end.
  bool started = false;       ///< It began: something may have moved.
  std::string fault;          ///< Why not done; empty if it was asked to stop.
  std::string collision;      ///< Why the scene's watch stopped it or did not let it start.
  double time = 0.0;          ///< s of the motion at the end.
  double stop_sent_ms = 0.0;  ///< From the request at most until STOP was sent to all devices.
  device::TrajectoryClient::Clock::time_point
      stop_sent;             ///< When they had been; unset if none was.
  double at_rest_ms = -1.0;  ///< From there until all were measured at rest; -1: not seen.
  std::vector<FollowingError> errors;  ///< Of each target.
};

/// Runs the motions that were uploaded to the targets together, from start to rest. What ends one
/// ends all: a fault, an exception of a device or of the observer, or a stop. Nothing moves if the
/// stop was requested before.
///
/// With a watch it starts, and goes on after a hold, only once the rest is free in the scene as it
/// is then, from where the robot is measured. An edit that leaves the rest unanswered for
/// SceneWatch::kLongestWait, or blocks it, holds the motion; where a hold would come too late it is
/// stopped.
/// @throws DeviceError if one can't start; all were stopped then, and waited for.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT MotionOutcome
run_motion(std::vector<MotionTarget>& targets, const device::MotionTolerances& tolerances,
           MotionRequests& requests, MotionObserver& observer);

}  // namespace handway::execution
