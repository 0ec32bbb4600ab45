#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// handway glove record: what a glove measures, into a file.
void add_glove_record(CLI::App& glove, int& exit_code);

}  // namespace handway::tools
