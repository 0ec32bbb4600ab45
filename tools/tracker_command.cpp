#include "tracker_command.h"

#include "tracker_emulate.h"
#include "tracker_live.h"

#include <CLI/CLI.hpp>

namespace handway::tools {

void add_tracker_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("tracker", "Use wrist trackers, or emulate one");
  command->require_subcommand(1);
  add_tracker_emulate(*command, exit_code);
  add_tracker_live(*command, exit_code);
}

}  // namespace handway::tools
