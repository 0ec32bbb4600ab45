#include "commands.h"
#include "glove_commands.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/device/glove/recording.h"
#include "handway/device/retargeting/mapping_check.h"
#include "handway/device/retargeting/mapping_fit.h"
#include "handway/device/retargeting/mapping_proposal.h"
#include "handway/geometric/formats/robot_loader.h"
#include "handway/geometric/io/resources.h"
#include "printing.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;

struct MapOptions {
  std::string robot;
  fs::path fit;
  fs::path calibration;
  fs::path out;
};

void print(const device::HandMapping& mapping) {
  for (const device::JointMapping& mapped : mapping.joints) {
    if (mapped.sensor < 0) {
      print_out("{:<23} fixed at {:.3f}\n", mapped.joint, mapped.fixed.value_or(0.0));
    } else {
      print_out("{:<23} {:<18}gain {:+.3f}, offset {:+.3f}\n", mapped.joint,
                device::cyberglove_sensors()[static_cast<std::size_t>(mapped.sensor)].name,
                mapped.gain, mapped.offset);
    }
  }
}

int map(const MapOptions& options) {
  const fs::path robot =
      geometric::find_resource(geometric::ResourceKind::kRobot, options.robot, fs::current_path());
  const auto model = geometric::load_robot(robot);
  device::HandMapping mapping = device::propose_mapping(*model);
  if (!options.fit.empty()) {
    const device::GloveCalibration calibration =
        options.calibration.empty() ? device::typical_calibration()
                                    : device::read_calibration(options.calibration);
    device::MappingFit fit = device::fit_mapping(
        mapping, *model, device::to_angles(device::read_recording(options.fit), calibration),
        calibration);
    for (const std::string& warning : fit.warnings) {
      print_error("warning: {}\n", warning);
    }
    mapping = std::move(fit.mapping);
    mapping.source += ", fitted to " + options.fit.filename().string();
  }
  for (const std::string& doubt : device::mapping_doubts(mapping, *model)) {
    print_error("warning: {}\n", doubt);
  }
  print(mapping);
  if (!options.out.empty()) {
    if (mapping.hand == model->name()) {  // readers of the mapping find the hand
      mapping.hand = geometric::resource_reference(geometric::ResourceKind::kRobot, robot,
                                                   fs::absolute(options.out).parent_path())
                         .string();
    }
    device::write_mapping(mapping, options.out);
  }
  return kDone;
}

}  // namespace

void add_glove_map(CLI::App& glove, int& exit_code) {
  auto options = std::make_shared<MapOptions>();
  CLI::App* command = glove.add_subcommand("map", "Propose a mapping of a glove to any robot hand");
  command
      ->add_option("robot", options->robot, "Robot hand, or an arm with a hand: name or URDF file")
      ->required();
  command->add_option(
      "--fit", options->fit,
      "Fit signs and ranges to this recording of an open hand, a fist and motions of the thumb");
  command->add_option("--calibration", options->calibration,
                      "Calibration of glove and person, for a recording of counts (default: a "
                      "typical right hand's)");
  command->add_option("--out", options->out, "File for the mapping (YAML)");
  command->callback([options, &exit_code] { exit_code = map(*options); });
}

}  // namespace handway::tools
