#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// handway tracker live: what a tracker measures, as it comes.
void add_tracker_live(CLI::App& tracker, int& exit_code);

}  // namespace handway::tools
