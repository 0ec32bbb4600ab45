#pragma once

#include "handway/device/core/injected_fault.h"
#include "handway/device/core/joint_trajectory.h"
#include "handway/device/export.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace handway::device {

struct RosControllerSettings {
  JointRanges joints;
  Eigen::VectorXd position;  ///< Where the joints are, rad.
  double lag = 0.01;         ///< Time constant of the servos, s.
  /// Time in which a stop brings a joint down from its full velocity, s.
  double braking_time = 0.25;
  InjectedFault fault;
};

/// An emulated robot in ROS, with a rosbridge server before it, without wires: messages and
/// time are given. It takes `trajectory_msgs/JointTrajectory` on every topic that was
/// advertised with this type, for all of its joints or some, and goes there as ROS's
/// joint_trajectory_controller does: at once, from where it is, linearly from point to point,
/// in the place of what it was doing with these joints. It runs on when its host is gone. ROS 1
/// and 2 alike. Time never goes back from call to call.
class HANDWAY_DEVICE_EXPORT RosController {
 public:
  using Messages = std::vector<std::string>;

  /// @throws std::invalid_argument for settings that make no sense.
  explicit RosController(RosControllerSettings settings);
  ~RosController();
  RosController(const RosController&) = delete;
  RosController& operator=(const RosController&) = delete;

  /// Takes a message of `host`. @returns what it answers.
  [[nodiscard]] Messages receive(std::uint64_t host, const std::string& text, double now);

  /// Lets time pass until `now` (s).
  void advance(double now);
  /// What it sends `host` every 10 ms: what it subscribed to.
  [[nodiscard]] Messages feedback(std::uint64_t host);

  [[nodiscard]] const Eigen::VectorXd& position() const;
  [[nodiscard]] bool moving() const;
  /// The fault, from when it begins on.
  [[nodiscard]] FaultKind active_fault() const;

 private:
  struct Robot;
  std::unique_ptr<Robot> robot_;
};

/// A RosController with its WebSocket port, run by a thread of its own: what programs for
/// rosbridge can be tried on. Only this computer can connect; several may at a time.
class HANDWAY_DEVICE_EXPORT RosEmulator {
 public:
  /// @param port 0: any that is free.
  /// @throws DeviceError if the port is taken; std::invalid_argument for settings that make no
  /// sense.
  RosEmulator(const RosControllerSettings& settings, std::uint16_t port);
  ~RosEmulator();
  RosEmulator(const RosEmulator&) = delete;
  RosEmulator& operator=(const RosEmulator&) = delete;

  /// "ros://localhost:9090"
  [[nodiscard]] const std::string& address() const;
  /// Where the joints are now, rad.
  [[nodiscard]] Eigen::VectorXd position() const;
  [[nodiscard]] bool moving() const;

 private:
  struct Running;
  std::unique_ptr<Running> running_;
};

}  // namespace handway::device
