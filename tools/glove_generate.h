#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// handway glove generate: a recording of a synthetic hand, faster than it would move.
void add_glove_generate(CLI::App& glove, int& exit_code);

}  // namespace handway::tools
