#pragma once

#include "handway/device/core/device_unit.h"
#include "handway/device/core/line_faults.h"
#include "handway/device/export.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace handway::device {

struct DeviceEmulatorSettings {
  LineFaultSettings faults;         ///< Of records that come by themselves; answers arrive whole.
  double latency = 0.0;             ///< Delay of everything that the unit sends, s.
  std::optional<double> unplug_at;  ///< DeviceUnit::set_plugged(false) so long after the start, s,
  std::optional<double> replug_at;  ///< and true again.
  /// A TCP port of this computer to listen on (0: any free one).
  std::optional<std::uint16_t> tcp_port;
  /// HOST:PORT to send every record to as a UDP datagram; hears nothing then.
  std::optional<std::string> udp_receiver;
};

/// An emulated device that programs can't tell from hardware: its unit on a pseudo-terminal (if
/// the settings name no port), run by a thread of its own. One host at a time; over TCP
/// a new connection takes the place of the last, as with serial-to-network converters.
class HANDWAY_DEVICE_EXPORT DeviceEmulator {
 public:
  /// Opens the port and starts. @pre `unit` is not null.
  /// @throws DeviceError if the port is taken or not allowed; std::invalid_argument for settings
  /// that make no sense.
  DeviceEmulator(const DeviceEmulatorSettings& settings, std::unique_ptr<DeviceUnit> unit);
  /// Closes the port at once, as if the cable were cut.
  ~DeviceEmulator();
  DeviceEmulator(const DeviceEmulator&) = delete;
  DeviceEmulator& operator=(const DeviceEmulator&) = delete;

  /// What a driver has to open: "/dev/pts/4" or "localhost:5555"; for UDP the receiver.
  [[nodiscard]] const std::string& address() const;

  /// See DeviceUnit::set_plugged().
  void set_plugged(bool plugged);

  /// Records that were sent, lost and damaged ones included.
  [[nodiscard]] std::uint64_t records() const;
  /// Records that were lost or damaged.
  [[nodiscard]] std::uint64_t faults() const;

 private:
  struct Running;
  std::unique_ptr<Running> running_;
};

}  // namespace handway::device
