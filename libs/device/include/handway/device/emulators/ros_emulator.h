#pragma once

#include "handway/device/core/joint_trajectory.h"
#include "handway/device/emulators/emulated_robot.h"
#include "handway/device/export.h"
#include "handway/device/ros/rosbridge.h"

#include <Eigen/Core>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace handway::device {

/// Settings of an emulated robot in ROS.
using RosControllerSettings = EmulatedRobotSettings;

/// An emulated robot in ROS, with a rosbridge server before it, without wires. It accepts
/// `trajectory_msgs/JointTrajectory` on every topic that was advertised with this type, for all of
/// its joints or some, and follows it as ROS's joint_trajectory_controller does: at once, from the
/// present position, linearly from point to point, replacing the former motion of these joints. It
/// continues when its host is gone. Both ROS 1 and ROS 2.
class HANDWAY_DEVICE_EXPORT RosController final : public EmulatedRobot {
 public:
  using Messages = std::vector<std::string>;

  /// @throws std::invalid_argument for invalid settings.
  explicit RosController(const RosControllerSettings& settings) : EmulatedRobot(settings) {}

  /// Takes a message of `host`. @returns the answer.
  [[nodiscard]] Messages receive(std::uint64_t host, const std::string& text, double now);

  /// Messages to `host` every 10 ms, of the topics that it subscribed to.
  [[nodiscard]] Messages feedback(std::uint64_t host);

 private:
  /// Goal of some of the joints.
  struct Goal {
    std::vector<Eigen::Index> joints;
    JointTrajectory motion;
    double begin = 0.0;       ///< s
    Eigen::VectorXd fastest;  ///< Largest speeds of the motion, rad/s.
  };

  bool do_step() override;
  void do_fail() override;
  void stop(int code);
  void take(const RosTrajectory& trajectory);
  [[nodiscard]] Goal goal_of(const RosTrajectory& trajectory) const;
  void obey(std::uint64_t host, const RosbridgeMessage& message);
  [[nodiscard]] RobotStatus status() const;

  std::vector<Goal> goals_;
  std::map<std::string, std::string> advertised_;             ///< Topics with their types.
  std::map<std::uint64_t, std::set<std::string>> listening_;  ///< Topics of each host.
  int error_code_ = 0;
};

/// A RosController with its WebSocket port, "ros://localhost:9090", for testing programs for
/// rosbridge. Several hosts may connect at a time.
class HANDWAY_DEVICE_EXPORT RosEmulator final : public RobotEmulator {
 public:
  /// @param port 0: any that is free.
  /// @throws DeviceError if the port is taken; std::invalid_argument for invalid
  /// settings.
  RosEmulator(const RosControllerSettings& settings, std::uint16_t port);
};

}  // namespace handway::device
