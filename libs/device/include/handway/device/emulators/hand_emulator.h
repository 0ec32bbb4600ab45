#pragma once

#include "handway/device/core/joint_trajectory.h"
#include "handway/device/emulators/emulated_robot.h"
#include "handway/device/export.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace handway::device {

/// Settings of an emulated hand controller.
struct HandControllerSettings : EmulatedRobotSettings {
  HandControllerSettings() {
    lag = 0.015;
    braking_time = 0.1;
  }

  std::size_t longest = 1000000;  ///< Capacity in points of a trajectory.
};

/// An emulated hand with the protocol of hand_protocol.h, without wires. It stores whole
/// trajectories and follows their time.
class HANDWAY_DEVICE_EXPORT HandController final : public EmulatedRobot {
 public:
  /// @throws std::invalid_argument for invalid settings.
  explicit HandController(const HandControllerSettings& settings);

  /// Takes a line of the host, without its end. @returns the answer: lines, or nothing.
  [[nodiscard]] std::string receive(const std::string& line, double now);

  /// Message sent every 10 ms; empty before a host has sent hello.
  [[nodiscard]] std::string feedback() const;

  /// Handles the loss of the host: it stops, and waits for another hello.
  void connection_lost();

 private:
  using Words = std::vector<std::string_view>;

  bool do_step() override;
  void do_fail() override;
  void end(const char* how);
  void fail(std::string why);
  void follow();
  [[nodiscard]] bool under_way() const { return phase_ == "running" || phase_ == "paused"; }
  /// @returns an answer. @throws LineProtocolError for a line of another protocol.
  std::string obey(const Words& words);
  std::string begin_trajectory(const Words& words);
  std::string take_point(const Words& words);

  std::size_t longest_;
  bool greeted_ = false;
  std::string phase_ = "idle";
  std::string fault_text_;
  JointTrajectory trajectory_;
  std::size_t expected_ = 0;  ///< Points of the trajectory that is coming in.
  double heard_ = 0.0;        ///< Time of the host's last message.
  double time_ = 0.0;         ///< Time of the motion.
  std::optional<double> hold_;
};

/// A HandController with its port: "hand://localhost:11100".
class HANDWAY_DEVICE_EXPORT HandEmulator final : public RobotEmulator {
 public:
  /// @param port 0: any that is free.
  /// @throws DeviceError if the port is taken; std::invalid_argument for invalid
  /// settings.
  HandEmulator(const HandControllerSettings& settings, std::uint16_t port);
};

}  // namespace handway::device
