#pragma once

#include "handway/device/export.h"
#include "handway/device/hand/hand_controller.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <string>

namespace handway::device {

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
