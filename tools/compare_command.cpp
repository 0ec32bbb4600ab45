#include "commands.h"
#include "figures_program.h"
#include "handway/execution/motion/motion_log.h"
#include "printing.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace handway::tools {
namespace {

struct CompareChoice {
  std::filesystem::path log;
  bool plots = false;
};

int compare(const CompareChoice& choice) {
  for (const execution::RecordedDevice& device : execution::read_motion_log(choice.log)) {
    print_out("{}: {} samples, {:.2f} s\n", device.kind, device.times.size(), device.times.back());
    print_out("{:<24}{:>12}{:>10}{:>12}\n", "", "max [rad]", "at [s]", "RMS [rad]");
    for (const execution::JointDifference& joint : execution::differences(device)) {
      print_out("{:<24}{:>12.5f}{:>10.2f}{:>12.5f}\n", joint.joint, joint.max, joint.time,
                joint.rms);
    }
  }
  if (choice.plots) {
    draw_figures(choice.log);
  }
  return kDone;
}

}  // namespace

void add_compare_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<CompareChoice>();
  CLI::App* command = app.add_subcommand("compare", "Compare measured with planned joints");
  command->add_option("log", choice->log, "Log of handway send (CSV)")->required();
  command->add_flag("--plots", choice->plots,
                    "Draw the differences as PNG and SVG, beside the log");
  command->callback([choice, &exit_code] { exit_code = compare(*choice); });
}

}  // namespace handway::tools
