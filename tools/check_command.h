#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// `handway check SCENE PATH.csv`: re-checks a path on the exact meshes.
void add_check_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
