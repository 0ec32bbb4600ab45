#include "commands.h"
#include "emulated_device.h"
#include "glove_commands.h"
#include "handway/device/emulators/glove_signals.h"
#include "handway/device/emulators/landmark_unit.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/hand_exploration.h"
#include "handway/device/glove/recording.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "numbers.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

struct EmulateOptions {
  ServeOptions serve;
  std::string protocol = "cyberglove";
  std::string receiver;
  double noise_mm = 1.0;
  int sensors = device::kGloveSensors;
  bool left = false;
  std::optional<double> rate_hz;
  std::uint64_t seed = 1;
  std::filesystem::path from;
  std::filesystem::path calibration;
  std::optional<double> noise;
  LineFaultOptions faults;
  std::vector<std::string> saturate;
};

int sensor_named(const std::string& name) {
  if (const auto sensor = device::find_sensor(name)) {
    return *sensor;
  }
  std::vector<std::string> names;
  for (const device::GloveSensor& sensor : device::cyberglove_sensors()) {
    names.emplace_back(sensor.name);
  }
  throw geometric::InputError({"--saturate", "", "\"" + name + "\"",
                               "a sensor's name or its letter, a to v",
                               geometric::advise_name(name, names)});
}

device::GloveSignal signal_of(const EmulateOptions& options) {
  const device::GloveCalibration calibration = options.calibration.empty()
                                                   ? device::typical_calibration()
                                                   : device::read_calibration(options.calibration);
  device::SensorFaults faults;
  for (const std::string& name : options.saturate) {
    faults.saturated.insert(sensor_named(name));
  }
  if (options.from.empty()) {
    faults.noise = options.noise.value_or(faults.noise);
    return exploring_hand_signal(options.seed, faults, calibration);
  }
  faults.noise = options.noise.value_or(0.0);
  return recorded_signal(device::read_recording(options.from), options.seed, faults, calibration);
}

device::HandSignal hand_of(const EmulateOptions& options) {
  if (options.from.empty()) {
    return [hand = std::make_shared<device::HandExploration>(options.seed)](double time) {
      return hand->at(time);
    };
  }
  const device::GloveCalibration calibration = options.calibration.empty()
                                                   ? device::typical_calibration()
                                                   : device::read_calibration(options.calibration);
  return recorded_hand(to_angles(device::read_recording(options.from), calibration));
}

/// Formats of hands by the names of their protocols.
const std::map<std::string, device::HandWire>& hand_wires() {
  static const std::map<std::string, device::HandWire> kWires{
      {"landmarks", device::HandWire::kLandmarks},
      {"openxr", device::HandWire::kOpenXr},
      {"rokoko", device::HandWire::kRokoko},
      {"rokoko-lz4", device::HandWire::kRokokoLz4},
      {"manus", device::HandWire::kManus}};
  return kWires;
}

int emulate_hand_sender(const EmulateOptions& options, device::HandWire wire) {
  device::DeviceEmulatorSettings settings = emulator_settings(options.faults, options.seed);
  ServeOptions serve = options.serve;
  if (!options.receiver.empty()) {
    settings.udp_receiver = options.receiver;
    serve.scheme = "udp://";
  } else if (serve.tcp_port && wire == device::HandWire::kRokokoLz4) {
    throw geometric::InputError({"--tcp", "", "a protocol of datagrams", "--to HOST:PORT",
                                 "Rokoko Studio sends frames of LZ4 by UDP only."});
  } else if (serve.tcp_port) {
    serve.scheme = "landmarks://";
  } else {
    throw geometric::InputError(
        {"--to", "", "nothing", "HOST:PORT or PORT to send landmarks to",
         "Write, for example, --to 5006, or --tcp 5006 to serve them on a port."});
  }
  device::LandmarkUnitSettings unit;
  unit.wire = wire;
  unit.rate = options.rate_hz.value_or(unit.rate);
  unit.left = options.left;
  unit.noise = options.noise_mm * geometric::kMillimetre;
  unit.seed = options.seed;
  return serve_device(settings, make_landmark_unit(unit, hand_of(options)), serve);
}

int emulate_glove(const EmulateOptions& options) {
  if (const auto wire = hand_wires().find(options.protocol); wire != hand_wires().end()) {
    return emulate_hand_sender(options, wire->second);
  }
  device::DeviceEmulatorSettings settings = emulator_settings(options.faults, options.seed);
  if (options.protocol == "cyberglove3" && options.receiver.empty()) {
    return serve_device(settings, std::make_unique<device::CyberGlove3Unit>(signal_of(options)),
                        options.serve);
  }
  if (!options.receiver.empty()) {
    settings.tcp_server = options.receiver;
    settings.greeting = {'o'};  // What a CyberGlove III says first over WiFi.
  }
  device::CyberGloveUnitSettings unit;
  unit.sensors = options.sensors;
  unit.right_hand = !options.left;
  unit.rate = options.rate_hz.value_or(unit.rate);
  return serve_device(settings, std::make_unique<device::CyberGloveUnit>(unit, signal_of(options)),
                      options.serve);
}

void add_signal_options(CLI::App& command, EmulateOptions& options) {
  command
      .add_option("--protocol", options.protocol,
                  "cyberglove (I and II), cyberglove3 (native stream of a CyberGlove III), "
                  "landmarks (21 points of a hand as JSON lines), openxr (26 joints as JSON "
                  "lines), rokoko, rokoko-lz4 (frames of Rokoko Studio, plain or compressed), or "
                  "manus (ergonomics of Manus Core as JSON lines)")
      ->check(CLI::IsMember(
          {"cyberglove", "cyberglove3", "landmarks", "openxr", "rokoko", "rokoko-lz4", "manus"}))
      ->capture_default_str();
  command.add_option(
      "--to", options.receiver,
      "HOST:PORT, or PORT of this computer: for landmarks, openxr, rokoko and manus the "
      "destination "
      "of UDP datagrams, otherwise the address to connect to, as a CyberGlove III does over WiFi");
  command.add_option("--sensors", options.sensors, "Number of sensors, 18 or 22")
      ->check(CLI::IsMember({18, 22}))
      ->capture_default_str();
  command.add_flag("--left", options.left, "Emulate a glove of the left hand");
  command
      .add_option(
          "--rate", options.rate_hz,
          "Frames per second, until the host sets another rate (default: 100; 30 for senders "
          "of hands)")
      ->check(CLI::Range(0.5, 480.0));
  command.add_option("--seed", options.seed, "Seed of the hand's motion and of all faults")
      ->check(not_negative())
      ->capture_default_str();
  command.add_option("--from", options.from,
                     "Play this recording in a loop, instead of a generated motion");
  command.add_option("--calibration", options.calibration,
                     "Calibration of glove and person (default: a typical right hand's)");
}

void add_fault_options(CLI::App& command, EmulateOptions& options) {
  command
      .add_option("--noise", options.noise,
                  "Noise of the sensors, counts (default: 0.4; 0 with --from)")
      ->check(CLI::Range(0.0, 100.0));
  command.add_option("--noise-mm", options.noise_mm, "Noise of landmarks, mm")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  add_line_fault_options(command, options.faults);
  command
      .add_option("--saturate", options.saturate, "Sensor (name or letter) that always reads 255")
      ->type_name("SENSOR")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace

void add_glove_emulate(CLI::App& glove, int& exit_code) {
  auto options = std::make_shared<EmulateOptions>();
  CLI::App* command = glove.add_subcommand("emulate",
                                           "Emulate a CyberGlove, or a program that sends a hand; "
                                           "the first line of output is its address");
  add_serve_options(*command, options->serve);
  add_signal_options(*command, *options);
  add_fault_options(*command, *options);
  command->callback([options, &exit_code] { exit_code = emulate_glove(*options); });
}

namespace {

constexpr int kMostSamples = 10'000'000;

struct GenerateOptions {
  std::uint64_t seed = 1;
  int samples = 13500;
  double rate = 100.0;
  std::filesystem::path out;
};

}  // namespace

void add_glove_generate(CLI::App& glove, int& exit_code) {
  auto options = std::make_shared<GenerateOptions>();
  CLI::App* command = glove.add_subcommand("generate", "Write a recording of the emulated hand");
  command->add_option("--seed", options->seed, "Seed of the hand's motion and the noise")
      ->check(not_negative())
      ->capture_default_str();
  command->add_option("--samples", options->samples, "Number of rows")
      ->check(CLI::Range(1, kMostSamples))
      ->capture_default_str();
  command->add_option("--rate", options->rate, "Rows per second")
      ->check(number_in(0.5, 1e4))
      ->capture_default_str();
  command->add_option("--out", options->out, "Recording to write (CSV)")->required();
  command->callback([options, &exit_code] {
    device::write_recording(
        device::generate_recording(options->seed, options->samples, options->rate), options->out);
    exit_code = kDone;
  });
}

}  // namespace handway::tools
