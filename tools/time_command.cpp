#include "commands.h"
#include "timing_options.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace handway::tools {

void add_time_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<TimingChoice>();
  CLI::App* command = app.add_subcommand(
      "time", "Compute the shortest duration of a path and run the pre-flight check");
  add_timing_options(*command, *choice);
  command->callback([choice, &exit_code] {
    planning::PluginManager plugins;
    plugins.load_plugins(planning::plugin_directory());
    const planning::TimedPath timed = run_timing(*choice, plugins);
    print_timing(timed);
    exit_code = timed.cleared() ? kDone : kNoPath;
  });
}

}  // namespace handway::tools
