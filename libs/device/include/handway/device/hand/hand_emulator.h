#pragma once

#include "handway/device/core/injected_fault.h"
#include "handway/device/core/joint_trajectory.h"
#include "handway/device/export.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <string>

namespace handway::device {

struct HandControllerSettings {
  JointRanges joints;
  Eigen::VectorXd position;  ///< Where the fingers are, rad.
  double lag = 0.015;        ///< Time constant of the servos, s.
  /// Time in which a stop brings a joint down from its full velocity, s.
  double braking_time = 0.1;
  std::size_t longest = 1000000;  ///< How many points of a trajectory it holds.
  InjectedFault fault;
};

/// An emulated hand that speaks hand_protocol.h, without wires: lines and time are given. It
/// holds whole trajectories and follows their time. Time never goes back from call to call.
class HANDWAY_DEVICE_EXPORT HandController {
 public:
  /// @throws std::invalid_argument for settings that make no sense.
  explicit HandController(HandControllerSettings settings);
  ~HandController();
  HandController(const HandController&) = delete;
  HandController& operator=(const HandController&) = delete;

  /// Takes a line of the host's, without its end. @returns what it answers: lines, or nothing.
  [[nodiscard]] std::string receive(const std::string& line, double now);

  /// Lets time pass until `now` (s).
  void advance(double now);
  /// What it sends every 10 ms; empty before a host has said hello.
  [[nodiscard]] std::string feedback();

  /// The host is gone: it stops, and waits for another hello.
  void connection_lost();

  [[nodiscard]] const Eigen::VectorXd& position() const;
  [[nodiscard]] bool moving() const;
  /// How many stop commands came. Loss of the connection, or silence, is none.
  [[nodiscard]] int stops() const;
  /// The fault, from when it begins on.
  [[nodiscard]] FaultKind active_fault() const;

 private:
  struct Hand;
  std::unique_ptr<Hand> hand_;
};

/// A HandController with its port, run by a thread of its own. Only this computer can connect.
class HANDWAY_DEVICE_EXPORT HandEmulator {
 public:
  /// @param port 0: any that is free.
  /// @throws DeviceError if the port is taken; std::invalid_argument for settings that make no
  /// sense.
  HandEmulator(const HandControllerSettings& settings, std::uint16_t port);
  ~HandEmulator();
  HandEmulator(const HandEmulator&) = delete;
  HandEmulator& operator=(const HandEmulator&) = delete;

  /// "hand://localhost:11100"
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
