#pragma once

#include "handway/execution/motion/motion_run.h"
#include "handway/execution/motion/motion_target.h"
#include "handway/planning/timing/time_path.h"

#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace handway::python {

/// The connected devices of a scene's robot. While no motion runs, a thread of its own polls them.
/// For any number of threads; one motion runs at a time.
class RobotConnection {
 public:
  /// @param to as execution::parse_targets() takes it.
  /// @throws InputError for devices that the robot lacks; DeviceError if one can't be reached.
  RobotConnection(std::shared_ptr<const planning::PlanningProblem> problem, const std::string& to,
                  const std::stop_token& stop);
  /// Stops running motions.
  ~RobotConnection();
  RobotConnection(const RobotConnection&) = delete;
  RobotConnection& operator=(const RobotConnection&) = delete;

  /// Result of a motion, with the largest deviation of each joint from its course, rad.
  struct Outcome {
    execution::MotionOutcome motion;
    std::vector<std::pair<std::string, double>> largest_errors;
  };

  /// Runs a motion to its end, or until `stop` or stop(). It begins only if it is free in the scene
  /// from the robot's measured position.
  /// @throws InputError if the motion is not cleared, is another robot's, or moves joints that no
  /// device does; DeviceError if a device can't begin.
  [[nodiscard]] Outcome run(const planning::TimedPath& timed,
                            const device::MotionTolerances& tolerances,
                            const std::stop_token& stop);
  /// Stops all devices at once; a running motion ends.
  void stop();
  /// Stops, and disconnects the devices. Later calls are refused.
  void close();

  /// Returns the measured configuration, other joints as in the scene's start; shape
  /// [variable_count].
  [[nodiscard]] geometric::Configuration measured();

 private:
  void listen(const std::stop_token& stop);
  void check_open() const;

  std::shared_ptr<const planning::PlanningProblem> problem_;
  std::mutex devices_;  ///< Guards the targets.
  std::vector<execution::MotionTarget> targets_;
  std::mutex running_mutex_;
  std::stop_source running_{std::nostopstate};  ///< Stops the running motion.
  std::jthread listener_;
};

}  // namespace handway::python
