#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// `handway pca RECORDING…`: finds a hand's principal motion directions.
void add_pca_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
