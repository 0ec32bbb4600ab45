#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// handway glove emulate: an emulated CyberGlove on a pseudo-terminal or a TCP port.
void add_glove_emulate(CLI::App& glove, int& exit_code);

}  // namespace handway::tools
