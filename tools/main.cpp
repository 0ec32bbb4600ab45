#include "commands.h"
#include "handway/geometric/formats/xacro_file.h"
#include "handway/geometric/io/input_error.h"
#include "printing.h"
#include "version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace handway::tools {
namespace {

// Adds environment variables that readers of files use, as options of every command.
void add_file_options(CLI::App& app) {
  app.fallthrough();
  app.add_option_function<std::string>(
         "--robot", [](const std::string& file) { ::setenv("HANDWAY_ROBOT", file.c_str(), 1); },
         "URDF of the robot that a MoveIt problem only names")
      ->type_name("FILE");
  app.add_option_function<std::vector<std::string>>(
         "--hollow",
         [](const std::vector<std::string>& names) {
           ::setenv("HANDWAY_HOLLOW", fmt::format("{}", fmt::join(names, "\n")).c_str(), 1);
         },
         "Hollow object, such as a cell around the robot: only its surface collides; may be given "
         "several times")
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option_function<std::vector<std::string>>(
         "--package-path",
         [](const std::vector<std::string>& folders) {
           const char* known = std::getenv("HANDWAY_PACKAGE_PATH");
           const std::string path =
               fmt::format("{}:{}", fmt::join(folders, ":"), known != nullptr ? known : "");
           ::setenv("HANDWAY_PACKAGE_PATH", path.c_str(), 1);
         },
         "Folder in which package:// of robot files is searched; may be given several times")
      ->type_name("DIR")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option_function<std::vector<std::string>>(
         "--xacro",
         [](const std::vector<std::string>& arguments) {
           for (const std::string& argument : arguments) {
             static_cast<void>(geometric::xacro_argument_of(argument, "--xacro"));
           }
           ::setenv("HANDWAY_XACRO", fmt::format("{}", fmt::join(arguments, "\n")).c_str(), 1);
         },
         "Argument of the xacro file of a robot; may be given several times")
      ->type_name("NAME:=VALUE")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

// Refuses empty texts for the options of all commands: they would act as if the option were
// missing.
void refuse_empty_texts(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    option->check([](const std::string& text) {
      return std::string(text.empty() ? "found an empty text, expected a value" : "");
    });
  }
  for (CLI::App* command : app.get_subcommands({})) {
    refuse_empty_texts(*command);
  }
}

// Prints the messages of CLI11, which quote the arguments.
int exit_of(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream out;
  std::ostringstream errors;
  const int code = app.exit(error, out, errors);
  print_out("{}", out.str());
  print_error("{}", errors.str());
  return code == 0 ? kDone : kWrongUsage;
}

int run(int argc, char** argv) {
  CLI::App app("Handway plans human-like motions of hand-arm robots.", "handway");
  app.set_version_flag("--version", kVersion);
  app.require_subcommand(1);
  add_file_options(app);
  int exit_code = kDone;
  add_plan_command(app, exit_code);
  add_check_command(app, exit_code);
  add_grasp_command(app, exit_code);
  add_task_command(app, exit_code);
  add_simulate_command(app, exit_code);
  add_dataset_command(app, exit_code);
  add_info_command(app, exit_code);
  add_setup_command(app, exit_code);
  add_pca_command(app, exit_code);
  add_time_command(app, exit_code);
  add_edit_command(app, exit_code);
  add_calibrate_command(app, exit_code);
  add_cloud_command(app, exit_code);
  add_export_command(app, exit_code);
  add_send_command(app, exit_code);
  add_compare_command(app, exit_code);
  add_arm_command(app, exit_code);
  add_hand_command(app, exit_code);
  add_ros_command(app, exit_code);
  add_haptic_command(app, exit_code);
  add_bench_command(app, exit_code);
  add_problems_command(app, exit_code);
  add_glove_command(app, exit_code);
  add_recording_command(app, exit_code);
  add_tracker_command(app, exit_code);
  add_reproduce_command(app, exit_code);
  refuse_empty_texts(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::RequiredError& error) {
    const std::vector<std::string> words = app.remaining();
    if (app.get_subcommands().empty() && !words.empty()) {
      print_error("handway: unknown command \"{}\". `handway --help` lists the commands.\n",
                  words.front());
      return kWrongUsage;
    }
    return exit_of(app, error);
  } catch (const CLI::ParseError& error) {
    return exit_of(app, error);
  }
  return exit_code;
}

}  // namespace
}  // namespace handway::tools

namespace {

// Flushes the output and checks it: a full disk must not look like success.
int flushed(int exit_code) {
  std::cout.flush();
  if (std::cout.good() && std::ferror(stdout) == 0 && std::fflush(stdout) == 0) {
    return exit_code;
  }
  handway::tools::print_error("handway: standard output can't be written: {}\n",
                              errno != 0 ? std::strerror(errno) : "an error");
  return exit_code == handway::tools::kDone ? handway::tools::kNotWritten : exit_code;
}

// Text " for FILE (N MB)", of the largest file among the arguments; empty if none is a file.
std::string largest_input(int argc, char** argv) {
  std::string name;
  std::uintmax_t largest = 0;
  for (int i = 1; i < argc; ++i) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(argv[i], error);
    if (!error && size >= largest) {
      largest = size;
      name = argv[i];
    }
  }
  return name.empty()
             ? ""
             : fmt::format(" for {} ({:.1f} MB)", name, 1e-6 * static_cast<double>(largest));
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error that can be reported
  try {
    return flushed(handway::tools::run(argc, argv));
  } catch (const handway::geometric::OutputError& error) {
    handway::tools::print_error("handway: {}\n", error.what());
    return handway::tools::kNotWritten;
  } catch (const std::system_error& error) {  // fmt could not print
    handway::tools::print_error("handway: standard output can't be written: {}\n", error.what());
    return handway::tools::kNotWritten;
  } catch (const std::bad_alloc&) {
    handway::tools::print_error(
        "handway: there is not enough memory{}. Use a smaller input, or raise the limit "
        "(ulimit -v)\n",
        largest_input(argc, argv));
    return handway::tools::kInvalidInput;
  } catch (const std::exception& error) {
    handway::tools::print_error("handway: {}\n", error.what());
    return handway::tools::kInvalidInput;
  }
}
