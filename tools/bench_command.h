#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// `handway bench [SCENE…]`: what collision checks and plans take.
void add_bench_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
