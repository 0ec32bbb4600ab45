#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// Adds `handway haptic guide`.
void add_haptic_guide(CLI::App& haptic, int& exit_code);

}  // namespace handway::tools
