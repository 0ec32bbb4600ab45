#include "commands.h"
#include "exit_codes.h"
#include "version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <exception>

namespace handway::tools {
namespace {

int run(int argc, char** argv) {
  CLI::App app("Handway plans human-like motions of hand-arm robots.", "handway");
  app.set_version_flag("--version", kVersion);
  app.require_subcommand(1);
  int exit_code = kDone;
  add_plan_command(app, exit_code);
  add_check_command(app, exit_code);
  add_info_command(app, exit_code);
  add_setup_command(app, exit_code);
  add_pca_command(app, exit_code);
  add_time_command(app, exit_code);
  add_export_command(app, exit_code);
  add_send_command(app, exit_code);
  add_compare_command(app, exit_code);
  add_arm_command(app, exit_code);
  add_hand_command(app, exit_code);
  add_ros_command(app, exit_code);
  add_haptic_command(app, exit_code);
  add_bench_command(app, exit_code);
  add_glove_command(app, exit_code);
  add_tracker_command(app, exit_code);
  add_reproduce_command(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kWrongUsage;
  }
  return exit_code;
}

}  // namespace
}  // namespace handway::tools

int main(int argc, char** argv) {
  try {
    return handway::tools::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "handway: {}\n", error.what());
    return handway::tools::kInvalidInput;
  }
}
