#pragma once

#include "handway/device/glove/glove_emulator.h"

#include <cstdint>
#include <optional>

namespace CLI {
class App;
}

namespace handway::tools {

/// Where an emulated glove is to be found, and for how long.
struct GloveServeOptions {
  std::optional<std::uint16_t> tcp_port;
  bool pty = false;
  std::optional<double> duration_s;
};

void add_glove_serve_options(CLI::App& command, GloveServeOptions& options);

/// Runs an emulated glove until Ctrl+C; its first line on standard output is what to connect to.
/// @returns the exit code.
[[nodiscard]] int serve_glove(device::GloveEmulatorSettings settings, device::GloveSignal signal,
                              const GloveServeOptions& options);

}  // namespace handway::tools
