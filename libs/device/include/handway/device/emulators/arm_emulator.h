#pragma once

#include "handway/device/arm/simple_message.h"
#include "handway/device/emulators/emulated_robot.h"
#include "handway/device/export.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace handway::device {

/// Settings of a controller of at most kSimpleMessageJoints joints.
struct Val3ControllerSettings : EmulatedRobotSettings {
  std::size_t queue = 10;  ///< Capacity in points.
  bool powered = true;
  bool automatic = true;
};

/// An emulated CS8 controller that runs the VAL3 server of ROS-Industrial, without wires: it
/// receives and answers messages. The arm moves from point to point so that its slowest joint has
/// the share of its velocity that the point requests, as `movej` does between blended points; a
/// point's duration is ignored. With an empty queue the arm is at rest.
class HANDWAY_DEVICE_EXPORT Val3Controller final : public EmulatedRobot {
 public:
  /// @throws std::invalid_argument for invalid settings.
  explicit Val3Controller(const Val3ControllerSettings& settings);

  /// Takes a message from the motion connection. @returns the answer.
  [[nodiscard]] SimpleMessage receive(const SimpleMessage& message, double now);

  /// Messages of the state connection every 20 ms: positions, and every fifth time status.
  [[nodiscard]] std::vector<SimpleMessage> feedback();

  /// Stops the motion after the loss of a connection.
  void connection_lost() { stop(); }

 private:
  struct Move {
    Eigen::VectorXd target;
    double velocity;  ///< Share of the joints' velocities.
  };

  bool do_step() override;
  void do_fail() override;
  void follow(double dt);
  void stop();
  [[nodiscard]] bool accepts(const SimpleMessage& point);
  [[nodiscard]] bool in_range(const Eigen::VectorXd& target) const;
  [[nodiscard]] RobotStatus status() const;

  std::size_t longest_queue_;
  bool powered_;
  bool automatic_;
  bool estopped_ = false;
  std::deque<Move> queue_;  ///< The first is running.
  int fed_back_ = 0;        ///< Times that positions were sent.
};

/// A Val3Controller with its two ports, "arm://localhost:11000": an emulated arm for testing
/// programs for ROS-Industrial's VAL3 server.
class HANDWAY_DEVICE_EXPORT ArmEmulator final : public RobotEmulator {
 public:
  /// @param port of motions; the state port is two above it, as with 11000 and 11002. 0: any two
  /// free ones.
  /// @throws DeviceError if a port is taken; std::invalid_argument for invalid settings.
  ArmEmulator(const Val3ControllerSettings& settings, std::uint16_t port);
};

}  // namespace handway::device
