#include "figures_program.h"

#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;

constexpr int kNotFound = 127;

// @returns the exit code; 127 if the program can't be started.
int run(std::vector<std::string> arguments) {
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) {
    pointers.push_back(argument.data());
  }
  pointers.push_back(nullptr);
  pid_t child = 0;
  if (::posix_spawnp(&child, pointers.front(), nullptr, nullptr, pointers.data(), environ) != 0) {
    return kNotFound;
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : EXIT_FAILURE;
}

fs::path figures_program() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  return program / "handway-figures";
}

}  // namespace

void draw_pictures(const fs::path& source) {
  const fs::path program = figures_program();
  if (!fs::exists(program)) {
    throw InputError({"handway-figures", "", "no program " + program.string(),
                      "this program, which draws the pictures",
                      "Build or install the workbench; the data are in " + source.string()});
  }
  const bool display = std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY");
  std::vector<std::string> command;
  if (!display) {
    command = {"xvfb-run", "-a", "-s", "-screen 0 1280x1024x24"};
  }
  command.insert(command.end(), {program.string(), source.string()});
  const int exit_code = run(command);
  if (exit_code == kNotFound && !display) {
    throw InputError({"handway-figures", "", "neither a display nor xvfb-run", "one of them",
                      "Install the package xvfb; the data are in " + source.string()});
  }
  if (exit_code != 0) {
    throw InputError({"handway-figures", "",
                      fmt::format("exit code {} of {}", exit_code, command.front()), "pictures",
                      "The data are in " + source.string()});
  }
}

}  // namespace handway::tools
