#pragma once

#include "handway/device/core/device_emulator.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace handway::tools {

/// Where an emulated device is to be found, and for how long.
struct ServeOptions {
  std::optional<std::uint16_t> tcp_port;
  bool pty = false;
  std::optional<double> duration_s;
};

/// @returns the option that names a TCP port.
CLI::Option* add_serve_options(CLI::App& command, ServeOptions& options);

/// What is wrong with an emulated device and its line.
struct LineFaultOptions {
  double dropout = 0.0;
  double garbage = 0.0;
  double latency_ms = 0.0;
  std::optional<double> unplug_after_s;
  std::optional<double> plug_again_after_s;
};

void add_line_fault_options(CLI::App& command, LineFaultOptions& options);

/// @param seed of the faults.
[[nodiscard]] device::DeviceEmulatorSettings emulator_settings(const LineFaultOptions& options,
                                                               std::uint64_t seed);

/// Prints `address`, what to connect to, and waits for Ctrl+C, or the end of the duration (s).
void wait_until_ended(const std::string& address, const std::optional<double>& duration);

/// Runs an emulated device until Ctrl+C; its first line on standard output is what to connect to.
/// @returns the exit code.
[[nodiscard]] int serve_device(device::DeviceEmulatorSettings settings,
                               std::unique_ptr<device::DeviceUnit> unit,
                               const ServeOptions& options);

}  // namespace handway::tools
