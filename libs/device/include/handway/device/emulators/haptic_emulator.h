#pragma once

#include "handway/device/emulators/injected_fault.h"
#include "handway/device/export.h"
#include "handway/device/haptic/haptic_protocol.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <string>

namespace handway::device {

/// Settings of an emulated haptic device with a compliant hand.
struct EmulatedHapticSettings {
  HapticAbilities abilities{3.3, {0.08, 0.06, 0.035}};  ///< Abilities of a Phantom Omni.
  double mass = 0.15;                                   ///< Mass of handle and hand, kg.
  double friction = 1.5;                                ///< Friction of the hand, N s/m.
  /// Tremor of the hand: peak force, N, in rotating directions.
  double tremble = 0.3;
  /// kNone, kLate, kLost, kRefused (its motors are too warm) or kEstop.
  InjectedFault fault;
};

/// An emulated haptic device with a compliant hand, without wires: lines and time are given. The
/// hand holds the button and goes where the device pushes it, with tremor. At the end of the
/// workspace, and after coming to rest, it releases the button, returns the handle to the middle
/// and presses again. Time never goes back from call to call.
class HANDWAY_DEVICE_EXPORT EmulatedHaptic {
 public:
  /// @throws std::invalid_argument for invalid settings.
  explicit EmulatedHaptic(const EmulatedHapticSettings& settings);

  /// Takes a line of the host, without its end. @returns the answer: a line, or nothing.
  [[nodiscard]] std::string receive(const std::string& line, double now);

  /// Simulates up to `now` (s).
  void advance(double now);
  /// Message sent every 2 ms; empty before a host has sent hello.
  [[nodiscard]] std::string feedback() const;

  /// Handles the loss of the host: the force ends, and it waits for another hello.
  void connection_lost();

  /// Present force of the motors, N.
  [[nodiscard]] const Eigen::Vector3d& force() const { return force_; }
  [[nodiscard]] const HapticSample& sample() const { return sample_; }
  /// The fault, once it has begun.
  [[nodiscard]] FaultKind active_fault() const {
    return fault_active_ ? settings_.fault.kind : FaultKind::kNone;
  }

 private:
  void step();
  void move_hand();
  void bring_back();
  [[nodiscard]] std::string obey(const std::string& line);
  [[nodiscard]] const char* fault_text() const;

  EmulatedHapticSettings settings_;
  HapticSample sample_;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  double now_ = 0.0;
  double forced_ = 0.0;   ///< Time of the last force.
  double resting_ = 0.0;  ///< s
  double guided_ = 0.0;   ///< s since the first force.
  bool greeted_ = false;
  bool has_guided_ = false;
  bool fault_active_ = false;
};

/// An EmulatedHaptic with its port, run by a thread of its own. Only this computer can connect.
class HANDWAY_DEVICE_EXPORT HapticEmulator {
 public:
  /// @param port 0: any that is free.
  /// @throws DeviceError if the port is taken; std::invalid_argument for invalid
  /// settings.
  HapticEmulator(const EmulatedHapticSettings& settings, std::uint16_t port);
  ~HapticEmulator();
  HapticEmulator(const HapticEmulator&) = delete;
  HapticEmulator& operator=(const HapticEmulator&) = delete;

  /// "haptic://localhost:11200"
  [[nodiscard]] const std::string& address() const;
  /// Present force of the motors, N.
  [[nodiscard]] Eigen::Vector3d force() const;

 private:
  struct Running;
  std::unique_ptr<Running> running_;
};

}  // namespace handway::device
