#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// Adds `handway hand` and its command `emulate`.
void add_hand_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
