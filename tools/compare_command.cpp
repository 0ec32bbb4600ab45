#include "commands.h"
#include "handway/execution/motion/motion_log.h"
#include "handway/report/rendering/report_files.h"
#include "handway/report/rendering/text.h"
#include "printing.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

struct CompareChoice {
  std::filesystem::path log;
  bool plots = false;
};

report::Document comparison(const std::vector<execution::RecordedDevice>& devices) {
  report::Document document;
  for (const execution::RecordedDevice& device : devices) {
    document.emplace_back(report::Paragraph{fmt::format("{}: {} samples, {:.2f} s", device.kind,
                                                        device.times.size(), device.times.back())});
    report::Table table{{"joint", {"max", "rad"}, {"at", "s"}, {"RMS", "rad"}}};
    for (const execution::JointDifference& joint : execution::differences(device)) {
      table.rows.push_back({joint.joint, report::fixed(joint.max, 5), report::fixed(joint.time, 2),
                            report::fixed(joint.rms, 5)});
    }
    document.push_back(std::move(table));
  }
  return document;
}

/// The following error of each joint over time.
report::Figure error_figure(const std::vector<execution::RecordedDevice>& devices) {
  constexpr double kMilli = 1e3;
  report::Figure figure{"Measured minus planned", {}, 3};
  for (const execution::RecordedDevice& device : devices) {
    const Eigen::MatrixXd errors = kMilli * (device.measured - device.planned);
    for (Eigen::Index j = 0; j < errors.cols(); ++j) {
      report::Series series{"", report::Mark::kLine, device.times};
      series.y.assign(errors.col(j).begin(), errors.col(j).end());
      figure.plots.push_back(report::XyPlot{device.joints[static_cast<std::size_t>(j)],
                                            {"time", "s"},
                                            {"error", "mrad"},
                                            {std::move(series)}});
    }
  }
  return figure;
}

int compare(const CompareChoice& choice) {
  const std::vector<execution::RecordedDevice> devices = execution::read_motion_log(choice.log);
  print_out("{}", report::to_text(comparison(devices)));
  if (choice.plots) {
    report::write_svg(error_figure(devices),
                      std::filesystem::path(choice.log).replace_extension(".svg"));
  }
  return kDone;
}

}  // namespace

void add_compare_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<CompareChoice>();
  CLI::App* command = app.add_subcommand("compare", "Compare measured with planned joints");
  command->add_option("log", choice->log, "Log of handway send (CSV)")->required();
  command->add_flag("--plots", choice->plots, "Draw the differences as SVG, beside the log");
  command->callback([choice, &exit_code] { exit_code = compare(*choice); });
}

}  // namespace handway::tools
