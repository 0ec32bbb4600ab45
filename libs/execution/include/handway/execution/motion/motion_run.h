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

/// Following errors of a device: its joints' measured minus planned positions; shapes [joints].
class HANDWAY_EXECUTION_EXPORT FollowingError {
 public:
  explicit FollowingError(Eigen::Index joints)
      : max_(Eigen::VectorXd::Zero(joints)), squares_(Eigen::VectorXd::Zero(joints)) {}

  void add(const Eigen::VectorXd& error);
  /// Adds the errors of another motion of the device.
  void add(const FollowingError& other);
  [[nodiscard]] int samples() const { return samples_; }
  [[nodiscard]] const Eigen::VectorXd& max() const { return max_; }  ///< Largest errors, rad.
  [[nodiscard]] Eigen::VectorXd rms() const;                         ///< Root mean squares, rad.

 private:
  Eigen::VectorXd max_;
  Eigen::VectorXd squares_;
  int samples_ = 0;
};

/// A device's planned and measured positions at one time of a motion.
struct MotionSample {
  double time = 0.0;         ///< Motion time of the measurement, s.
  std::size_t target = 0;    ///< Index of the device among the targets.
  Eigen::VectorXd planned;   ///< Planned positions, rad, shape [joints of the device].
  Eigen::VectorXd measured;  ///< Measured positions, rad, shape [joints of the device].
};

/// Callbacks of a running motion, called on its thread. An exception of a callback is a fault: it
/// stops the motion, and the observer is not called again.
class HANDWAY_EXECUTION_EXPORT MotionObserver {
 public:
  virtual ~MotionObserver() = default;
  virtual void on_sample(const MotionSample& sample) = 0;
  /// Called every few milliseconds. @param time motion time, s. @param errors so far, by target.
  virtual void on_progress(double time, const std::vector<FollowingError>& errors) = 0;
  /// Called with the index of a part of the motion when it begins, see run_parts().
  virtual void on_part(std::size_t /*part*/) {}
  /// Called when the scene has held the motion: MotionRequests::hold is set. Called again when the
  /// reason changes, also if the rest becomes free: then hold can be set to false.
  virtual void on_held(const std::string& /*reason*/) {}
};

/// Requests to a running motion, allowed from any thread.
struct MotionRequests {
  std::stop_token stop;
  /// Holds the motion while true. run_motion() sets it if its watch finds a reason to hold, and
  /// continues only after the caller has cleared it.
  std::atomic<bool> hold = false;
  /// Watch of this motion; null: the scene is not edited, and the motion was checked just before.
  SceneWatch* watch = nullptr;
};

/// Result of a motion on devices.
struct MotionOutcome {
  bool done = false;          ///< The motion reached its end.
  bool started = false;       ///< The motion began: joints may have moved.
  std::string fault;          ///< Message of the first fault; empty: none.
  std::string collision;      ///< Reason why the watch stopped or refused the motion; empty: none.
  double time = 0.0;          ///< Motion time of the last sample, s.
  double stop_sent_ms = 0.0;  ///< Upper bound on the time from request to STOP sent to all, ms.
  device::TrajectoryClient::Clock::time_point
      stop_sent;             ///< Time when STOP was sent to all before the end; unset otherwise.
  double at_rest_ms = -1.0;  ///< Time from the stop or the end to rest, ms; -1: not measured.
  std::vector<FollowingError> errors;  ///< Following errors of each target.
};

/// Runs the motions that were uploaded to the targets together, from start to rest. A fault, an
/// exception of a device or of the observer, or a stop ends the motion of all targets. Nothing
/// moves if the stop was requested before.
///
/// With a watch, the motion starts, and continues after a hold, only once its rest is free in the
/// current scene, from the robot's measured configuration. The motion is held if its rest is
/// blocked, or unchecked for SceneWatch::kLongestWait. It is stopped if the conflict comes before
/// the hold.
/// @param tolerances their `give` is that of all variables of the robot, [variable_count], or of
/// size 0.
/// @throws DeviceError if a device can't start, after stopping all and waiting for their rest.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT MotionOutcome
run_motion(std::vector<MotionTarget>& targets, const device::MotionTolerances& tolerances,
           MotionRequests& requests, MotionObserver& observer);

}  // namespace handway::execution
