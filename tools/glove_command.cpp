#include "commands.h"
#include "glove_commands.h"
#include "handway/device/glove/cyberglove.h"
#include "handway/device/glove/landmark_glove.h"

#include <CLI/CLI.hpp>

#include <optional>

namespace handway::tools {
void add_glove_device_options(CLI::App& command, GloveDeviceOptions& options) {
  command
      .add_option(
          "--device", options.device,
          "Serial port (/dev/ttyUSB0) or HOST:PORT of a CyberGlove; udp://PORT to hear hand "
          "landmarks, landmarks://HOST:PORT to fetch them")
      ->required();
  command.add_option("--rate", options.rate_hz, "Frames a second to ask for")
      ->check(CLI::Range(0.5, 480.0))
      ->capture_default_str();
  command.add_option("--baud", options.baud, "Speed of a serial port, bit/s")
      ->check(CLI::Range(1200, 921600))
      ->capture_default_str();
  command.add_flag("--poll", options.poll, "Ask for every frame instead of letting it stream");
  command.add_option("--hand", options.hand, "With landmarks: left or right (default: the first)")
      ->check(CLI::IsMember({"left", "right"}));
}

std::unique_ptr<device::Glove> make_glove(const GloveDeviceOptions& options) {
  if (device::is_landmark_address(options.device)) {
    return std::make_unique<device::LandmarkGlove>(
        options.device, device::LandmarkGloveSettings{options.hand.empty()
                                                          ? std::nullopt
                                                          : std::optional(options.hand == "left")});
  }
  device::CyberGloveSettings settings;
  settings.rate = options.rate_hz;
  settings.baud = options.baud;
  settings.polled = options.poll;
  return std::make_unique<device::CyberGlove>(options.device, settings);
}

void add_glove_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("glove", "Use sensorized gloves, or emulate one");
  command->require_subcommand(1);
  add_glove_calibrate(*command, exit_code);
  add_glove_emulate(*command, exit_code);
  add_glove_generate(*command, exit_code);
  add_glove_live(*command, exit_code);
  add_glove_map(*command, exit_code);
  add_glove_record(*command, exit_code);
  add_glove_replay(*command, exit_code);
}

}  // namespace handway::tools
