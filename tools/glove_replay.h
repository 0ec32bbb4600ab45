#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// handway glove replay: a recording played as if it came from a glove.
void add_glove_replay(CLI::App& glove, int& exit_code);

}  // namespace handway::tools
