#include "emulated_device.h"

#include "commands.h"
#include "handway/execution/motion/motion_target.h"
#include "handway/geometric/io/input_error.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "numbers.h"
#include "parameter_options.h"
#include "printing.h"
#include "terminal.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cstdio>
#include <map>
#include <random>
#include <stop_token>
#include <thread>
#include <vector>

namespace handway::tools {
namespace {

using device::FaultKind;

constexpr double kEarliestFault = 0.2;  // s
constexpr double kLatestFault = 1.0;    // s

const std::map<std::string, FaultKind>& fault_names() {
  static const std::map<std::string, FaultKind> kNames{
      {"none", FaultKind::kNone},   {"late", FaultKind::kLate},
      {"lost", FaultKind::kLost},   {"refused", FaultKind::kRefused},
      {"estop", FaultKind::kEstop}, {"joint-limit", FaultKind::kJointLimit},
      {"slow", FaultKind::kSlow}};
  return kNames;
}

}  // namespace

void add_emulator_options(CLI::App& command, EmulatedDeviceChoice& choice,
                          const std::vector<std::string>& faults) {
  command.add_option("--port", choice.port, "TCP port on this computer; 0: any free one")
      ->capture_default_str();
  command
      .add_option("--fault", choice.fault,
                  fmt::format("Fault to inject: {}", fmt::join(faults, ", ")))
      ->check(CLI::IsMember(faults))
      ->type_name("FAULT")
      ->capture_default_str();
  command
      .add_option("--fault-after", choice.fault_after_s,
                  "Time of the fault, s from the beginning of a motion (default: 0.2 to 1, drawn "
                  "by the seed)")
      ->check(positive_number());
  command.add_option("--seed", choice.seed, "Seed of the time of the fault")
      ->check(not_negative())
      ->capture_default_str();
  command.add_option("--duration", choice.duration_s, "End after this time, s")
      ->check(positive_number());
}

void add_emulated_device_options(CLI::App& command, EmulatedDeviceChoice& choice) {
  std::vector<std::string> faults{"none"};
  for (const auto& [name, kind] : fault_names()) {
    if (kind != FaultKind::kNone) {
      faults.push_back(name);
    }
  }
  add_emulator_options(command, choice, faults);
  command.add_option("--scene", choice.scene, "Emulate the robot of this scene, at its start");
  command.add_option("--lag-ms", choice.lag_ms, "Time constant of the servos, ms")
      ->check(positive_number())
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
}

EmulatedPosture scene_posture(const std::filesystem::path& scene, const std::string& kind) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  const planning::SceneState loaded = planning::load_scene(scene, plugins);
  const planning::PlanningProblem problem =
      planning::make_problem(loaded.scene, loaded.basis, {}, planning::GoalNeed::kOptional);
  const geometric::JointIndices variables = problem.joints.of_part(kind);
  if (variables.empty()) {
    throw geometric::InputError({scene.string(), "", "a robot without joints of its " + kind,
                                 "a robot with a group \"" + kind + "\"", ""});
  }
  EmulatedPosture posture{execution::device_joints(problem.model(), variables),
                          Eigen::VectorXd(static_cast<Eigen::Index>(variables.size()))};
  for (std::size_t j = 0; j < variables.size(); ++j) {
    posture.position[static_cast<Eigen::Index>(j)] = problem.start[variables[j]];
  }
  return posture;
}

device::InjectedFault chosen_fault(const EmulatedDeviceChoice& choice) {
  // std::uniform_real_distribution differs from library to library.
  std::mt19937_64 bits(choice.seed);
  const double drawn = static_cast<double>(bits() >> 11U) * 0x1.0p-53;
  return {fault_names().at(choice.fault),
          choice.fault_after_s.value_or(kEarliestFault + (kLatestFault - kEarliestFault) * drawn)};
}

int serve_device(const std::string& address, const EmulatedDeviceChoice& choice) {
  wait_until_ended(address, choice.duration_s);
  return kDone;
}

CLI::Option* add_serve_options(CLI::App& command, ServeOptions& options) {
  CLI::Option* tcp = command.add_option(
      "--tcp", options.tcp_port, "Listen on this TCP port on this computer; 0: any free one");
  command.add_flag("--pty", options.pty, "Open a pseudo-terminal that acts as a serial port")
      ->excludes(tcp);
  command.add_option("--duration", options.duration_s, "End after this time, s")
      ->check(positive_number());
  return tcp;
}

void add_line_fault_options(CLI::App& command, LineFaultOptions& options) {
  add_parameter_options(command, parameters_of(options.faults));
  command.add_option("--latency", options.latency_ms, "Delay of all output, ms")
      ->check(CLI::Range(0.0, 60000.0));
  command
      .add_option("--unplug-after", options.unplug_after_s,
                  "Unplug the glove or tracker from its interface unit after this time, s")
      ->check(positive_number());
  command
      .add_option("--plug-again-after", options.plug_again_after_s,
                  "Plug it in again at this time after the start, s")
      ->check(positive_number());
}

device::DeviceEmulatorSettings emulator_settings(const LineFaultOptions& options,
                                                 std::uint64_t seed) {
  device::DeviceEmulatorSettings settings;
  settings.faults = options.faults;
  settings.faults.seed = seed;
  settings.latency = options.latency_ms / 1000.0;
  settings.unplug_at = options.unplug_after_s;
  settings.replug_at = options.plug_again_after_s;
  return settings;
}

void wait_until_ended(const std::string& address, const std::optional<double>& duration) {
  using Clock = std::chrono::steady_clock;
  std::stop_source stop;
  const StopsOnInterrupt guard(stop);
  print_out("{}\n", address);
  std::fflush(stdout);
  const auto begin = Clock::now();
  while (!stop.stop_requested() &&
         !(duration && Clock::now() - begin > std::chrono::duration<double>(*duration))) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

int serve_device(device::DeviceEmulatorSettings settings, std::unique_ptr<device::DeviceUnit> unit,
                 const ServeOptions& options) {
  settings.tcp_port = options.tcp_port;
  const device::DeviceEmulator emulator(settings, std::move(unit));
  wait_until_ended(options.scheme + emulator.address(), options.duration_s);
  print_error("{} records sent, {} of them lost or damaged\n", emulator.records(),
              emulator.faults());
  return kDone;
}

}  // namespace handway::tools
