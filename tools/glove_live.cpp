#include "glove_live.h"

#include "glove_device_options.h"
#include "glove_show.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace handway::tools {

void add_glove_live(CLI::App& glove, int& exit_code) {
  struct Options {
    GloveDeviceOptions device;
    GloveShowOptions show;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = glove.add_subcommand("live", "Show what a glove measures");
  add_glove_device_options(*command, options->device);
  add_glove_show_options(*command, options->show);
  command->callback([options, &exit_code] {
    exit_code = show_glove(make_glove(options->device), options->show);
  });
}

}  // namespace handway::tools
