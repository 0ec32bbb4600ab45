#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// Adds `handway send PATH.csv --scene SCENE --to DEVICE`.
void add_send_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
