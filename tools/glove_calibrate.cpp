#include "commands.h"
#include "glove_commands.h"
#include "handway/device/glove/angle_ranges.h"
#include "handway/device/glove/calibration_fit.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/guided_poses.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "numbers.h"
#include "printing.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
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
  double hand_length = 0.0;        ///< mm; 0: not measured.
  std::vector<std::string> bones;  ///< FINGER=MM,MM,MM,MM.
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
  if (pose == known.end() || pose->motion > 0.0) {
    std::vector<std::string> names;
    std::ranges::transform(known, std::back_inserter(names), &PoseInstruction::name);
    throw geometric::InputError({"--pose " + name, "", "no pose of that name",
                                 "the name of a pose, as --list shows",
                                 pose != known.end() ? "Give its recording to --free"
                                                     : geometric::advise_name(name, names)});
  }
  return {pose->name, pose->angles, device::read_recording(text.substr(equals + 1))};
}

// The poses' lines, and those of the free motion for sensors without any pose.
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

/// Lines of sensors without a pose, ranges of the joints and, for landmarks, bones.
CalibrationFit with_free_motion(const CalibrateOptions& options,
                                std::optional<CalibrationFit> poses) {
  const device::Recording motion = device::read_recording(options.free);
  CalibrationFit result =
      poses.value_or(CalibrationFit{{options.person, options.date, {}, {}, {}, {}}, {}});
  if (motion.header.kind == device::RecordingKind::kCounts) {
    const CalibrationFit free = device::calibrate_from_range(
        motion, device::typical_angle_ranges(),
        options.before.empty() ? device::typical_calibration()
                               : device::read_calibration(options.before),
        options.person, options.date);
    result = poses ? joined(*poses, free) : free;
  }
  result.calibration.ranges =
      device::measured_ranges(device::to_angles(motion, result.calibration));
  result.calibration.bones = motion.bones;
  return result;
}

device::HandBones typed_bones(const CalibrateOptions& options,
                              const std::optional<device::HandBones>& measured) {
  device::HandBones bones = measured.value_or(device::typical_bones());
  if (options.hand_length > 0.0) {
    bones = device::typical_bones(options.hand_length * geometric::kMillimetre);
  }
  for (const std::string& text : options.bones) {
    const std::size_t equals = text.find('=');
    std::size_t finger = 0;
    while (finger < bones.size() &&
           device::name_of(static_cast<device::Finger>(finger)) != text.substr(0, equals)) {
      ++finger;
    }
    const std::vector<std::string> parts =
        CLI::detail::split(equals == std::string::npos ? "" : text.substr(equals + 1), ',');
    std::array<double, 4> lengths{};
    bool good = finger < bones.size() && parts.size() == lengths.size();
    for (std::size_t i = 0; good && i < lengths.size(); ++i) {
      good = CLI::detail::lexical_cast(parts[i], lengths.at(i)) && lengths.at(i) > 0.0 &&
             std::isfinite(lengths.at(i));
      lengths.at(i) *= geometric::kMillimetre;
    }
    if (!good) {
      throw CLI::ValidationError("--bones",
                                 "\"" + text +
                                     "\" is not FINGER=MM,MM,MM,MM with thumb, index, middle, ring "
                                     "or little, and lengths above 0");
    }
    bones.at(finger) = lengths;
  }
  return bones;
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
    result = with_free_motion(options, result);
  }
  if (options.hand_length > 0.0 || !options.bones.empty()) {
    result = result ? result : CalibrationFit{{options.person, options.date, {}, {}, {}, {}}, {}};
    result->calibration.bones = typed_bones(options, result->calibration.bones);
  }
  if (!result) {
    throw CLI::RequiredError("--pose, --free, --hand-length, --bones or --list");
  }
  return *result;
}

void print(const CalibrationFit& found) {
  for (std::size_t i = 0; i < device::kGloveSensors; ++i) {
    const std::string_view name = device::cyberglove_sensors()[i].name;
    const std::optional<device::SensorCalibration>& line = found.calibration.sensors.at(i);
    if (!line && std::ranges::none_of(found.calibration.sensors,
                                      [](const auto& other) { return other.has_value(); })) {
      continue;  // of angles: nothing to calibrate
    }
    if (!line) {
      print_out("{:<18} not calibrated\n", name);
      continue;
    }
    print_out("{:<18} {:+.5f} rad per count, zero at {:.1f}{}\n", name, line->gain, line->zero,
              line->residual ? fmt::format(", error {:.3f} rad", *line->residual) : "");
  }
  for (std::size_t i = 0; i < device::kGloveSensors; ++i) {
    if (const auto& range = found.calibration.ranges.at(i)) {
      print_out("{:<18} range {:.0f} to {:.0f} deg\n", device::cyberglove_sensors()[i].name,
                range->first / geometric::kDegree, range->second / geometric::kDegree);
    }
  }
  for (std::size_t f = 0; found.calibration.bones && f < found.calibration.bones->size(); ++f) {
    const auto& bones = found.calibration.bones->at(f);
    print_out("{:<18} bones {:.1f}, {:.1f}, {:.1f}, {:.1f} mm\n",
              device::name_of(static_cast<device::Finger>(f)), bones[0] / geometric::kMillimetre,
              bones[1] / geometric::kMillimetre, bones[2] / geometric::kMillimetre,
              bones[3] / geometric::kMillimetre);
  }
  for (const std::string& warning : found.warnings) {
    print_out("warning: {}\n", warning);
  }
}

int calibrate(const CalibrateOptions& options) {
  if (options.list) {
    for (const PoseInstruction& pose : instructions(options)) {
      print_out("{:<14}{}\n", pose.name, pose.instruction);
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
  CLI::App* command = glove.add_subcommand(
      "calibrate", "Compute the calibration of a glove: sensors, joint ranges and bone lengths");
  command->add_option("--pose", options->poses, "Recording of the person holding a pose")
      ->type_name("NAME=RECORDING")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_flag("--list", options->list, "List the poses with the instructions for the person");
  command->add_option("--poses", options->pose_file,
                      "File of poses, instead of those that ship (YAML)");
  command->add_option(
      "--free", options->free,
      "Recording of a motion through all postures of the hand, of counts, angles or landmarks");
  command->add_option(
      "--before", options->before,
      "Calibration whose signs are used for --free (default: a typical right hand's)");
  command
      ->add_option("--hand-length", options->hand_length,
                   "Length from the crease of the wrist to the tip of the middle finger, mm; all "
                   "bones are scaled to it")
      ->check(positive_number());
  command
      ->add_option(
          "--bones", options->bones,
          "Measured lengths, mm: from the wrist to the base of the finger, then bone by bone")
      ->type_name("FINGER=MM,MM,MM,MM")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--person", options->person,
                      "Name of the person, written to the calibration");
  command->add_option("--date", options->date, "Date of the recording, written to the calibration");
  command->add_option("--out", options->out, "File for the calibration (YAML)");
  command->callback([options, &exit_code] { exit_code = calibrate(*options); });
}

}  // namespace handway::tools
