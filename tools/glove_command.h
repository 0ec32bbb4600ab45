#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// handway glove emulate|live|record|replay …
void add_glove_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
