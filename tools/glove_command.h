#pragma once

#include "handway/device/glove/glove.h"

#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace handway::tools {

/// Which glove, and how to read it.
struct GloveDeviceOptions {
  std::string device;
  double rate_hz = 100.0;
  int baud = 115200;
  bool poll = false;
};

void add_glove_device_options(CLI::App& command, GloveDeviceOptions& options);

[[nodiscard]] std::unique_ptr<device::Glove> make_glove(const GloveDeviceOptions& options);

}  // namespace handway::tools
