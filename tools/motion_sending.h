#pragma once

#include "handway/execution/motion/motion_parts.h"
#include "handway/execution/motion/motion_target.h"
#include "scene_file_watch.h"

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace handway::tools {

/// A tenth of the full speed: that of motions on hardware, unless the user chooses another one.
inline constexpr double kCautiousSpeed = 0.1;
/// Time between two points of a motion on hardware, s: an arm's queue of ten does not run empty.
inline constexpr double kPointPeriod = 0.02;

/// Devices, and how they run a motion.
struct SendOptions {
  std::string to;             ///< See execution::parse_targets().
  std::filesystem::path log;  ///< For execution::MotionLog; empty: none.
  device::MotionTolerances tolerances;
  bool yes = false;  ///< The robot may move.
};

/// Adds the options `--to`, `--yes`, `--log` and the tolerances. @returns `--to`; the others need
/// it.
CLI::Option* add_send_options(CLI::App& command, SendOptions& options);

/// Connects all devices. @returns whether all were connected before a stop was requested.
/// @throws DeviceError if a device can't be reached.
[[nodiscard]] bool connect(const std::vector<execution::MotionTarget>& targets,
                           const std::stop_token& stop);

/// A motion that is cleared to run, and the files that it depends on.
struct Sending {
  std::vector<execution::MotionPart> parts;
  double speed = 1.0;           ///< Share of full speed, for display.
  std::vector<SeenFile> files;  ///< Their state when they were read.
  /// Called on a thread of its own when one of the files is edited.
  std::function<void(execution::SceneWatch&)> on_edit;
};

/// Prints what is sent, runs the motion on the devices if options.yes, and prints its progress and
/// result. A motion that is held because of an edit continues if its rest is free, and else ends.
/// @param targets connected. @param stop ends the motion: STOP is sent to all devices.
/// @returns the exit code of the program.
[[nodiscard]] int send_parts(const SendOptions& options,
                             std::vector<execution::MotionTarget>& targets, Sending sending,
                             std::stop_source& stop);

/// Says that nothing moved. @returns the exit code of the program.
[[nodiscard]] int end_before_the_start();

}  // namespace handway::tools
