#pragma once

#include "handway/device/core/injected_fault.h"
#include "handway/device/core/joint_trajectory.h"

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace handway::tools {

/// What `handway arm emulate`, `hand emulate` and `ros emulate` ask for alike.
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
/// Those, and the ones of devices that move joints: scene and lag.
void add_emulated_device_options(CLI::App& command, EmulatedDeviceChoice& choice);

/// The joints of a device, and where they are, rad.
struct EmulatedPosture {
  device::JointRanges joints;
  Eigen::VectorXd position;
};

/// The scene's "arm", "hand" or kWholeRobot, at its start.
/// @throws InputError if it can't be read or its robot has no such part.
[[nodiscard]] EmulatedPosture scene_posture(const std::filesystem::path& scene,
                                            const std::string& kind);

/// The fault, with a time drawn by the seed (0.2 to 1 s) if none is given.
[[nodiscard]] device::InjectedFault chosen_fault(const EmulatedDeviceChoice& choice);

/// Prints `address` and waits for Ctrl+C, or the end of the duration. @returns the exit code.
[[nodiscard]] int serve_device(const std::string& address, const EmulatedDeviceChoice& choice);

}  // namespace handway::tools
