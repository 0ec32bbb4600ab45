#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// `handway plan SCENE`: finds a path and writes it.
void add_plan_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
