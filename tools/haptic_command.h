#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// Adds `handway haptic` and its commands `guide` and `emulate`.
void add_haptic_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
