#pragma once

#include "handway/device/arm/simple_message.h"
#include "handway/device/core/injected_fault.h"
#include "handway/device/core/joint_trajectory.h"
#include "handway/device/export.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace handway::device {

struct Val3ControllerSettings {
  JointRanges joints;        ///< At most kSimpleMessageJoints.
  Eigen::VectorXd position;  ///< Where the arm stands, rad.
  double lag = 0.01;         ///< Time constant of the servos, s.
  std::size_t queue = 10;    ///< How many points it holds.
  /// Time in which a stop brings a joint down from its full velocity, s.
  double braking_time = 0.25;
  bool powered = true;
  bool automatic = true;
  InjectedFault fault;
};

/// An emulated CS8 controller that runs the VAL3 server of ROS-Industrial, without wires: what it
/// receives and what it answers are messages, and time is given. The arm moves from point to point
/// so that its slowest joint goes at the share of its velocity that the point asks for, as `movej`
/// does between points that are blended; a point's duration plays no part. Where the queue is
/// empty the arm stands.
///
/// Time never goes back from call to call.
class HANDWAY_DEVICE_EXPORT Val3Controller {
 public:
  /// @throws std::invalid_argument for settings that make no sense.
  explicit Val3Controller(Val3ControllerSettings settings);
  ~Val3Controller();
  Val3Controller(const Val3Controller&) = delete;
  Val3Controller& operator=(const Val3Controller&) = delete;

  /// Takes a message from the motion connection. @returns what it answers.
  [[nodiscard]] SimpleMessage receive(const SimpleMessage& message, double now);

  /// Lets time pass until `now` (s).
  void advance(double now);
  /// What the state connection sends every 20 ms: positions, and every fifth time status.
  [[nodiscard]] std::vector<SimpleMessage> feedback();

  /// Loss of a connection stops the motion.
  void connection_lost();

  [[nodiscard]] const Eigen::VectorXd& position() const;
  [[nodiscard]] bool moving() const;
  /// How many stop commands came. Loss of a connection is none.
  [[nodiscard]] int stops() const;
  /// The fault, from when it begins on.
  [[nodiscard]] FaultKind active_fault() const;

 private:
  struct Arm;
  std::unique_ptr<Arm> arm_;
};

/// A Val3Controller with its two ports, run by a thread of its own: an emulated arm that
/// programs for ROS-Industrial's VAL3 server can be tried on. Only this computer can connect.
class HANDWAY_DEVICE_EXPORT ArmEmulator {
 public:
  /// @param port of motions; the state port is the next but one, as 11000 and 11002 are. 0:
  /// any two that are free.
  /// @throws DeviceError if a port is taken; std::invalid_argument for settings that make no sense.
  ArmEmulator(const Val3ControllerSettings& settings, std::uint16_t port);
  ~ArmEmulator();
  ArmEmulator(const ArmEmulator&) = delete;
  ArmEmulator& operator=(const ArmEmulator&) = delete;

  /// "arm://localhost:11000"
  [[nodiscard]] const std::string& address() const;
  /// Where the joints are now, rad.
  [[nodiscard]] Eigen::VectorXd position() const;
  [[nodiscard]] bool moving() const;
  /// How many stop commands came.
  [[nodiscard]] int stops() const;

 private:
  struct Running;
  std::unique_ptr<Running> running_;
};

}  // namespace handway::device
