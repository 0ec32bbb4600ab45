#pragma once

#include "handway/device/export.h"
#include "handway/device/ros/ros_controller.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <string>

namespace handway::device {

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
