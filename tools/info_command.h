#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// `handway info SCENE|ROBOT`: what was loaded, with warnings.
void add_info_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
