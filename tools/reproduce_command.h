#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// `handway reproduce`: the paper's tables, measured again.
void add_reproduce_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
