#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// Adds `handway arm` and its command `emulate`.
void add_arm_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
