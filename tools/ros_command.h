#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// Adds `handway ros` and its command `emulate`.
void add_ros_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
