#pragma once

#include "handway/device/export.h"
#include "handway/device/haptic/emulated_haptic.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <string>

namespace handway::device {

/// An EmulatedHaptic with its port, run by a thread of its own. Only this computer can connect.
class HANDWAY_DEVICE_EXPORT HapticEmulator {
 public:
  /// @param port 0: any that is free.
  /// @throws DeviceError if the port is taken; std::invalid_argument for settings that make no
  /// sense.
  HapticEmulator(const EmulatedHapticSettings& settings, std::uint16_t port);
  ~HapticEmulator();
  HapticEmulator(const HapticEmulator&) = delete;
  HapticEmulator& operator=(const HapticEmulator&) = delete;

  /// "haptic://localhost:11200"
  [[nodiscard]] const std::string& address() const;
  /// What its motors do now, N.
  [[nodiscard]] Eigen::Vector3d force() const;

 private:
  struct Running;
  std::unique_ptr<Running> running_;
};

}  // namespace handway::device
