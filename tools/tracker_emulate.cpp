#include "tracker_emulate.h"

#include "device_serve.h"
#include "handway/device/tracker/tracker_units.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "number_options.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace handway::tools {
namespace {

struct EmulateOptions {
  ServeOptions serve;
  std::string protocol = "fastrak";
  std::string receiver;
  device::TrackerUnitSettings unit;
  std::uint64_t seed = 1;
  double position_noise_mm = 0.2;
  double angle_noise_deg = 0.03;
  LineFaultOptions faults;
};

std::unique_ptr<device::DeviceUnit> make_unit(const EmulateOptions& options) {
  const device::TrackerNoise noise{options.position_noise_mm * geometric::kMillimetre,
                                   options.angle_noise_deg * geometric::kDegree};
  const device::TrackerSignal signal = wrist_motion_signal(options.seed, noise);
  try {
    if (options.protocol == "udp") {
      return make_datagram_unit(options.unit, signal);
    }
    return options.protocol == "liberty" ? make_liberty_unit(options.unit, signal)
                                         : make_fastrak_unit(options.unit, signal);
  } catch (const std::invalid_argument& problem) {
    throw geometric::InputError({"--sensors", "", std::to_string(options.unit.sensors),
                                 problem.what(), "Take fewer, or another --protocol."});
  }
}

int emulate(const EmulateOptions& options) {
  device::DeviceEmulatorSettings settings = emulator_settings(options.faults, options.seed);
  if (options.protocol == "udp") {
    if (options.receiver.empty()) {
      throw geometric::InputError({"--to", "", "nothing", "HOST:PORT or PORT to send poses to",
                                   "Write, for example, --to 5005."});
    }
    settings.udp_receiver = options.receiver;
  }
  return serve_device(settings, make_unit(options), options.serve);
}

}  // namespace

void add_tracker_emulate(CLI::App& tracker, int& exit_code) {
  auto options = std::make_shared<EmulateOptions>();
  CLI::App* command =
      tracker.add_subcommand("emulate", "Be a tracker; the first line says what to connect to");
  CLI::Option* tcp = add_serve_options(*command, options->serve);
  command->add_option("--protocol", options->protocol, "fastrak, liberty or udp")
      ->check(CLI::IsMember({"fastrak", "liberty", "udp"}))
      ->capture_default_str();
  command->add_option("--to", options->receiver, "With udp: HOST:PORT, or PORT of this computer")
      ->excludes(tcp);
  command->add_option("--sensors", options->unit.sensors, "How many sensors it has")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_option("--rate", options->unit.rate, "Poses a second")
      ->check(CLI::Range(0.5, 1000.0))
      ->capture_default_str();
  command->add_flag("--button", options->unit.button,
                    "The first sensor has a button, pressed every other second");
  command->add_option("--seed", options->seed, "Seed of the wrist's motion and of all faults")
      ->check(not_negative())
      ->capture_default_str();
  command->add_option("--position-noise", options->position_noise_mm, "Noise of positions, mm")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command->add_option("--angle-noise", options->angle_noise_deg, "Noise of orientations, deg")
      ->check(CLI::Range(0.0, 30.0))
      ->capture_default_str();
  add_line_fault_options(*command, options->faults);
  command->callback([options, &exit_code] { exit_code = emulate(*options); });
}

}  // namespace handway::tools
