#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// `handway export PATH.csv`: times a path and writes it for a controller.
void add_export_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
