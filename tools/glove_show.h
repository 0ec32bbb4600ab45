#pragma once

#include "handway/device/glove/glove.h"

#include <cstdint>
#include <memory>

namespace CLI {
class App;
}

namespace handway::tools {

struct GloveShowOptions {
  std::uint64_t frames = 0;  ///< Stop after so many; 0: at Ctrl+C or the end.
  bool json = false;
};

void add_glove_show_options(CLI::App& command, GloveShowOptions& options);

/// Shows what a glove measures: on a terminal a table that is refreshed, else a line a frame.
/// @throws geometric::InputError if it can't be connected.
/// @returns the exit code.
[[nodiscard]] int show_glove(std::unique_ptr<device::Glove> glove, const GloveShowOptions& options);

}  // namespace handway::tools
