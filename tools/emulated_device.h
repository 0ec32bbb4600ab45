#pragma once

#include "handway/device/core/joint_trajectory.h"
#include "handway/device/emulators/device_emulator.h"
#include "handway/device/emulators/injected_fault.h"

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace handway::tools {

/// Common options of `handway arm emulate`, `hand emulate` and `ros emulate`.
struct EmulatedDeviceChoice {
  std::uint16_t port = 0;
  std::filesystem::path scene;
  std::string fault = "none";
  std::optional<double> fault_after_s;
  std::uint64_t seed = 1;
  double lag_ms = 10.0;
  std::optional<double> duration_s;
};

/// Options of all emulated devices: port, faults, duration.
/// @param faults names of those that the device knows.
void add_emulator_options(CLI::App& command, EmulatedDeviceChoice& choice,
                          const std::vector<std::string>& faults);
/// Adds the options of all emulated devices, and scene and lag of those that move joints.
void add_emulated_device_options(CLI::App& command, EmulatedDeviceChoice& choice);

/// The joints of a device with their positions, rad.
struct EmulatedPosture {
  device::JointRanges joints;
  Eigen::VectorXd position;
};

/// The scene's "arm", "hand" or kWholeRobot, at its start.
/// @throws InputError if it can't be read or its robot has no such part.
[[nodiscard]] EmulatedPosture scene_posture(const std::filesystem::path& scene,
                                            const std::string& kind);

/// The fault, with a time from the seed (0.2 to 1 s) by default.
[[nodiscard]] device::InjectedFault chosen_fault(const EmulatedDeviceChoice& choice);

/// Prints `address` and waits for Ctrl+C, or the end of the duration. @returns the exit code.
[[nodiscard]] int serve_device(const std::string& address, const EmulatedDeviceChoice& choice);

/// Address of an emulated device, and the duration of its service.
struct ServeOptions {
  std::optional<std::uint16_t> tcp_port;
  bool pty = false;
  std::optional<double> duration_s;
  std::string scheme;  ///< Prefix of the printed address.
};

/// @returns the option that names a TCP port.
CLI::Option* add_serve_options(CLI::App& command, ServeOptions& options);

/// Faults of an emulated device and its line.
struct LineFaultOptions {
  device::LineFaultSettings faults;  ///< Without their seed.
  double latency_ms = 0.0;
  std::optional<double> unplug_after_s;
  std::optional<double> plug_again_after_s;
};

void add_line_fault_options(CLI::App& command, LineFaultOptions& options);

/// @param seed of the faults.
[[nodiscard]] device::DeviceEmulatorSettings emulator_settings(const LineFaultOptions& options,
                                                               std::uint64_t seed);

/// Prints `address` for clients, and waits for Ctrl+C, or the end of the duration (s).
void wait_until_ended(const std::string& address, const std::optional<double>& duration);

/// Runs an emulated device until Ctrl+C; its first line on standard output is its address.
/// @returns the exit code.
[[nodiscard]] int serve_device(device::DeviceEmulatorSettings settings,
                               std::unique_ptr<device::DeviceUnit> unit,
                               const ServeOptions& options);

}  // namespace handway::tools
