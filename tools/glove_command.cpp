#include "glove_command.h"

#include "glove_calibrate.h"
#include "glove_emulate.h"
#include "glove_generate.h"
#include "glove_live.h"
#include "glove_record.h"
#include "glove_replay.h"

#include <CLI/CLI.hpp>

namespace handway::tools {

void add_glove_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("glove", "Use sensorized gloves, or emulate one");
  command->require_subcommand(1);
  add_glove_calibrate(*command, exit_code);
  add_glove_emulate(*command, exit_code);
  add_glove_generate(*command, exit_code);
  add_glove_live(*command, exit_code);
  add_glove_record(*command, exit_code);
  add_glove_replay(*command, exit_code);
}

}  // namespace handway::tools
