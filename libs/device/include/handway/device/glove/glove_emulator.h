#pragma once

#include "handway/device/core/device_emulator.h"
#include "handway/device/core/line_faults.h"
#include "handway/device/export.h"
#include "handway/device/glove/cyberglove_unit.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace handway::device {

/// A CyberGlove on a port.
struct GloveEmulatorSettings : DeviceEmulatorSettings {
  CyberGloveUnitSettings unit;
};

/// An emulated CyberGlove that programs can't tell from hardware: its interface unit on a
/// pseudo-terminal or a TCP port, run by a thread of its own. One host at a time; over TCP
/// a new connection takes the place of the last, as with serial-to-network converters.
class HANDWAY_DEVICE_EXPORT GloveEmulator {
 public:
  /// Opens the port and starts.
  /// @throws DeviceError if the port is taken or not allowed; std::invalid_argument for settings
  /// that make no sense.
  GloveEmulator(const GloveEmulatorSettings& settings, GloveSignal signal);

  /// What a driver has to open: "/dev/pts/4" or "localhost:5555".
  [[nodiscard]] const std::string& address() const { return emulator_.address(); }

  /// Pulls the glove off its unit, or puts it back on.
  void set_plugged(bool plugged) { emulator_.set_plugged(plugged); }

  /// Records that were sent, lost and damaged ones included.
  [[nodiscard]] std::uint64_t records() const { return emulator_.records(); }
  /// Records that were lost or damaged.
  [[nodiscard]] std::uint64_t faults() const { return emulator_.faults(); }

 private:
  DeviceEmulator emulator_;
};

}  // namespace handway::device
