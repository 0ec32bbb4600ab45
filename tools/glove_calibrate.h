#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

/// handway glove calibrate: a calibration from recordings of guided poses and of a free motion.
void add_glove_calibrate(CLI::App& glove, int& exit_code);

}  // namespace handway::tools
