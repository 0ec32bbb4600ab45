#pragma once

#include "handway/device/core/watchdog.h"
#include "handway/device/export.h"
#include "handway/device/haptic/haptic_protocol.h"

#include <Eigen/Core>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

namespace handway::device {

/// A handle that reports its position in a user's hand and exerts forces.
///
/// To be used by one thread, which calls read() and then apply() in turn. Any failure ends the
/// force: of the connection, after silence, or of the program.
class HANDWAY_DEVICE_EXPORT HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  HapticDevice(const HapticDevice&) = delete;
  HapticDevice& operator=(const HapticDevice&) = delete;

  /// Name as the user wrote it: "haptic://localhost:11200".
  [[nodiscard]] const std::string& name() const { return name_; }
  /// @pre connected.
  [[nodiscard]] const HapticAbilities& abilities() const { return abilities_; }

  /// @throws DeviceError if it can't be reached, or is another device.
  void connect(const std::stop_token& stop = {});

  /// The newest sample since the last call; nothing if none came within `timeout`. Reads at most
  /// 256 KiB, and 5 ms from the first bytes on, however much the device sends.
  /// @throws DeviceError, after a force of 0, if the device has a fault, the connection broke, or
  /// for 0.1 s it has reported nothing or more than can be read.
  [[nodiscard]] std::optional<HapticSample> read(std::chrono::milliseconds timeout);

  /// Pushes the hand until the next call, or until the device has received nothing for 0.05 s.
  /// @param force N, in the device's frame; limited to the device's ability, and 0 if it is not
  /// finite. @throws DeviceError if the connection broke.
  void apply(const Eigen::Vector3d& force);

  /// Ends the force. Never throws: a device that can't be reached any more ends it itself.
  void release();

 protected:
  /// Result of one read.
  struct Reading {
    std::optional<HapticSample> newest;
    bool all = true;  ///< Everything pending was read.
  };

  explicit HapticDevice(std::string name) : name_(std::move(name)) {}

  /// For derived classes. @throws DeviceError with this device's name.
  [[noreturn]] void refuse(std::string found, std::string expected, std::string advice) const;

 private:
  [[nodiscard]] virtual HapticAbilities do_connect(const std::stop_token& stop) = 0;
  [[nodiscard]] virtual Reading do_read(std::chrono::milliseconds timeout) = 0;
  virtual void do_apply(const Eigen::Vector3d& force) = 0;

  std::string name_;
  HapticAbilities abilities_;
  Watchdog watchdog_;
  Backlog backlog_;
};

/// A haptic device behind a TCP port with the protocol of haptic_protocol.h.
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

/// Parses "haptic://HOST[:PORT]" without connecting.
/// @throws geometric::InputError for anything else.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::unique_ptr<HapticDevice> make_haptic_device(
    const std::string& address);

}  // namespace handway::device
