#include "commands.h"
#include "version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

// What readers of files look up in the environment, as options of every command.
void add_file_options(CLI::App& app) {
  app.fallthrough();
  app.add_option_function<std::string>(
         "--robot", [](const std::string& file) { ::setenv("HANDWAY_ROBOT", file.c_str(), 1); },
         "URDF of the robot that an imported problem only names (MoveIt)")
      ->type_name("FILE");
  app.add_option_function<std::vector<std::string>>(
         "--package-path",
         [](const std::vector<std::string>& folders) {
           const char* known = std::getenv("HANDWAY_PACKAGE_PATH");
           const std::string path =
               fmt::format("{}:{}", fmt::join(folders, ":"), known != nullptr ? known : "");
           ::setenv("HANDWAY_PACKAGE_PATH", path.c_str(), 1);
         },
         "Folder with packages, as package:// in robot files means them; may be given several "
         "times")
      ->type_name("DIR")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

int run(int argc, char** argv) {
  CLI::App app("Handway plans human-like motions of hand-arm robots.", "handway");
  app.set_version_flag("--version", kVersion);
  app.require_subcommand(1);
  add_file_options(app);
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
  } catch (const CLI::RequiredError& error) {
    if (const std::vector<std::string> words = app.remaining(); !words.empty()) {
      fmt::print(stderr, "handway: unknown command \"{}\". `handway --help` lists all.\n",
                 words.front());
      return kWrongUsage;
    }
    return app.exit(error) == 0 ? kDone : kWrongUsage;
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
