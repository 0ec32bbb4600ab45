#pragma once

#include "handway/device/arm/simple_message.h"
#include "handway/device/core/injected_fault.h"
#include "handway/device/core/joint_trajectory.h"
#include "handway/device/export.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
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

}  // namespace handway::device
