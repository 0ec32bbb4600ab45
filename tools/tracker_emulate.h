#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// handway tracker emulate: an emulated tracker on a pseudo-terminal, a TCP port or by UDP.
void add_tracker_emulate(CLI::App& tracker, int& exit_code);

}  // namespace handway::tools
