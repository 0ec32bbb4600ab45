#include "glove_device_options.h"

#include "handway/device/glove/cyberglove.h"

#include <CLI/CLI.hpp>

namespace handway::tools {

void add_glove_device_options(CLI::App& command, GloveDeviceOptions& options) {
  command.add_option("--device", options.device, "Serial port (/dev/ttyUSB0) or HOST:PORT")
      ->required();
  command.add_option("--rate", options.rate_hz, "Frames a second to ask for")
      ->check(CLI::Range(0.5, 480.0))
      ->capture_default_str();
  command.add_option("--baud", options.baud, "Speed of a serial port, bit/s")
      ->check(CLI::Range(1200, 921600))
      ->capture_default_str();
  command.add_flag("--poll", options.poll, "Ask for every frame instead of letting it stream");
}

std::unique_ptr<device::Glove> make_glove(const GloveDeviceOptions& options) {
  device::CyberGloveSettings settings;
  settings.rate = options.rate_hz;
  settings.baud = options.baud;
  settings.polled = options.poll;
  return std::make_unique<device::CyberGlove>(options.device, settings);
}

}  // namespace handway::tools
