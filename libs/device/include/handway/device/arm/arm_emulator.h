#pragma once

#include "handway/device/arm/val3_controller.h"
#include "handway/device/export.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <string>

namespace handway::device {

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
