#pragma once

#include "handway/planning/core/plugin.h"
#include "handway/planning/timing/time_path.h"

#include <filesystem>

namespace CLI {
class App;
}

namespace handway::tools {

/// What `handway time` and `handway export` ask for alike.
struct TimingChoice {
  std::filesystem::path path;
  std::filesystem::path scene;
  std::filesystem::path limits;
  std::filesystem::path report;
  double speed = 1.0;
  double period_ms = 4.0;
  double deviation = planning::BlendOptions{}.deviation;
  double arc_clearance_mm = 1.0;
  bool no_blend = false;
};

void add_timing_options(CLI::App& command, TimingChoice& choice);

/// Reads scene and path and times the path. Writes the report if one is asked for.
/// @throws InputError for files and options that are wrong.
[[nodiscard]] planning::TimedPath run_timing(const TimingChoice& choice,
                                             const planning::Extensions& extensions);

/// Prints what a person wants to know.
void print_timing(const planning::TimedPath& timed);

}  // namespace handway::tools
