#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// handway glove live: what a glove measures, as it comes.
void add_glove_live(CLI::App& glove, int& exit_code);

}  // namespace handway::tools
