#include "figures_program.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <iterator>
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

void draw_figures(const fs::path& source) {
  const fs::path program = figures_program();
  if (!fs::exists(program)) {
    throw InputError({"figures", "", "no program " + program.string(),
                      "this program, which draws the figures",
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
    throw InputError({"figures", "", "neither a display nor xvfb-run", "one of them",
                      "Install the package xvfb; the data are in " + source.string()});
  }
  if (exit_code != 0) {
    throw InputError({"figures", "", fmt::format("exit code {} of {}", exit_code, command.front()),
                      "drawings", "The data are in " + source.string()});
  }
}

namespace {

std::string table_text(const std::vector<std::string>& header, const Eigen::MatrixXd& rows) {
  std::string text = fmt::format("{}\n", fmt::join(header, ","));
  for (Eigen::Index row = 0; row < rows.rows(); ++row) {
    for (Eigen::Index column = 0; column < rows.cols(); ++column) {
      fmt::format_to(std::back_inserter(text), "{}{}", column > 0 ? "," : "", rows(row, column));
    }
    text += '\n';
  }
  return text;
}

}  // namespace

void write_basis_plots(const fs::path& folder, const sampling::PmdBasis& basis,
                       const Eigen::MatrixXd& postures, const Eigen::VectorXd& shares) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw InputError({folder.string(), "", error.message(), "a folder for figures", ""});
  }
  geometric::replace_file(folder / "postures.csv", table_text(basis.joints, postures));
  geometric::replace_file(folder / "variance.csv", table_text({"share"}, shares));
  sampling::write_pmd_basis(basis, folder / "basis.yaml");
  draw_figures(folder);
}

}  // namespace handway::tools
