#include "commands.h"
#include "glove_commands.h"
#include "handway/device/glove/calibration_fit.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using device::CalibrationFit;
using device::PoseInstruction;

struct CalibrateOptions {
  std::vector<std::string> poses;  ///< NAME=RECORDING.
  fs::path pose_file;
  fs::path free;
  fs::path before;
  std::string person;
  std::string date;
  bool list = false;
  fs::path out;
};

std::vector<PoseInstruction> instructions(const CalibrateOptions& options) {
  return device::read_guided_poses(options.pose_file.empty()
                                       ? geometric::resource_dir() / "poses" / "guided_poses.yaml"
                                       : options.pose_file);
}

device::GuidedPose recorded_pose(const std::string& text,
                                 const std::vector<PoseInstruction>& known) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    throw CLI::ValidationError("--pose", "\"" + text + "\" is not NAME=RECORDING");
  }
  const std::string name = text.substr(0, equals);
  const auto pose = std::ranges::find(known, name, &PoseInstruction::name);
  if (pose == known.end()) {
    std::vector<std::string> names;
    std::ranges::transform(known, std::back_inserter(names), &PoseInstruction::name);
    throw geometric::InputError({"--pose " + name, "", "no pose of that name",
                                 "one that --list shows", geometric::advise_name(name, names)});
  }
  return {pose->name, pose->angles, device::read_recording(text.substr(equals + 1))};
}

// The poses' lines, and those of the free motion for sensors that no pose says anything of.
CalibrationFit joined(const CalibrationFit& poses, const CalibrationFit& free) {
  CalibrationFit result = poses;
  for (std::size_t i = 0; i < device::kGloveSensors; ++i) {
    if (!result.calibration.sensors.at(i)) {
      result.calibration.sensors.at(i) = free.calibration.sensors.at(i);
    }
  }
  result.calibration.source += "; others: " + free.calibration.source;
  result.warnings.insert(result.warnings.end(), free.warnings.begin(), free.warnings.end());
  return result;
}

CalibrationFit fit(const CalibrateOptions& options) {
  std::optional<CalibrationFit> result;
  if (!options.poses.empty()) {
    const std::vector<PoseInstruction> known = instructions(options);
    std::vector<device::GuidedPose> poses;
    poses.reserve(options.poses.size());
    for (const std::string& pose : options.poses) {
      poses.push_back(recorded_pose(pose, known));
    }
    result = device::calibrate_from_poses(poses, options.person, options.date);
  }
  if (!options.free.empty()) {
    const CalibrationFit free = device::calibrate_from_range(
        device::read_recording(options.free), device::typical_angle_ranges(),
        options.before.empty() ? device::typical_calibration()
                               : device::read_calibration(options.before),
        options.person, options.date);
    result = result ? joined(*result, free) : free;
  }
  if (!result) {
    throw CLI::RequiredError("--pose, --free or --list");
  }
  return *result;
}

void print(const CalibrationFit& found) {
  for (std::size_t i = 0; i < device::kGloveSensors; ++i) {
    const std::string_view name = device::cyberglove_sensors()[i].name;
    const std::optional<device::SensorCalibration>& line = found.calibration.sensors.at(i);
    if (!line) {
      fmt::print("{:<18} not calibrated\n", name);
      continue;
    }
    fmt::print("{:<18} {:+.5f} rad per count, zero at {:.1f}{}\n", name, line->gain, line->zero,
               line->residual ? fmt::format(", off by {:.3f} rad", *line->residual) : "");
  }
  for (const std::string& warning : found.warnings) {
    fmt::print("warning: {}\n", warning);
  }
}

int calibrate(const CalibrateOptions& options) {
  if (options.list) {
    for (const PoseInstruction& pose : instructions(options)) {
      fmt::print("{:<14}{}\n", pose.name, pose.instruction);
    }
    return kDone;
  }
  const CalibrationFit found = fit(options);
  print(found);
  if (!options.out.empty()) {
    device::write_calibration(found.calibration, options.out);
  }
  return kDone;
}

}  // namespace

void add_glove_calibrate(CLI::App& glove, int& exit_code) {
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* command =
      glove.add_subcommand("calibrate", "Find the calibration of a glove on a hand");
  command->add_option("--pose", options->poses, "What was recorded while a pose was held")
      ->type_name("NAME=RECORDING")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_flag("--list", options->list, "Tell the poses and what to ask for");
  command->add_option("--poses", options->pose_file, "Other poses than those that ship (YAML)");
  command->add_option("--free", options->free,
                      "A recording of a motion through all that the hand can do");
  command->add_option("--before", options->before,
                      "Calibration whose signs hold for --free (default: a typical right hand's)");
  command->add_option("--person", options->person, "Whose hand it is");
  command->add_option("--date", options->date, "When it was recorded");
  command->add_option("--out", options->out, "Write the calibration here (YAML)");
  command->callback([options, &exit_code] { exit_code = calibrate(*options); });
}

}  // namespace handway::tools
