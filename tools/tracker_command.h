#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// handway tracker emulate|live …
void add_tracker_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
