#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/cyberglove_unit.h"
#include "handway/device/glove/line_faults.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace handway::device {

struct GloveEmulatorSettings {
  CyberGloveUnitSettings unit;
  LineFaultSettings faults;         ///< Of sampled records; answers to commands arrive whole.
  double latency = 0.0;             ///< Delay of everything that the unit sends, s.
  std::optional<double> unplug_at;  ///< Pull the glove off so long after the start, s,
  std::optional<double> replug_at;  ///< and put it back on.
  /// A TCP port of this computer to listen on (0: any free one); without, a pseudo-terminal.
  std::optional<std::uint16_t> tcp_port;
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
  /// Closes the port at once, as if the cable were cut.
  ~GloveEmulator();
  GloveEmulator(const GloveEmulator&) = delete;
  GloveEmulator& operator=(const GloveEmulator&) = delete;

  /// What a driver has to open: "/dev/pts/4" or "localhost:5555".
  [[nodiscard]] const std::string& address() const;

  /// Pulls the glove off its unit, or puts it back on.
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
