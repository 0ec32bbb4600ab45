#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// Adds `handway compare`.
void add_compare_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
