#pragma once

#include "handway/device/export.h"
#include "handway/device/haptic/haptic_device.h"

#include <cstdint>
#include <memory>
#include <string>

namespace handway::device {

/// A haptic device behind a TCP port that speaks haptic_protocol.h.
class HANDWAY_DEVICE_EXPORT NetworkHaptic final : public HapticDevice {
 public:
  /// @param name for messages.
  NetworkHaptic(std::string name, std::string host, std::uint16_t port);
  ~NetworkHaptic() override;

 private:
  [[nodiscard]] HapticAbilities do_connect(const std::stop_token& stop) override;
  [[nodiscard]] Reading do_read(std::chrono::milliseconds timeout) override;
  void do_apply(const Eigen::Vector3d& force) override;

  struct Wire;
  std::unique_ptr<Wire> wire_;
};

/// Reads "haptic://HOST[:PORT]"; nothing is connected.
/// @throws geometric::InputError for anything else.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::unique_ptr<HapticDevice> make_haptic_device(
    const std::string& address);

}  // namespace handway::device
