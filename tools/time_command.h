#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// `handway time PATH.csv`: how long a path takes, and whether it may run.
void add_time_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
