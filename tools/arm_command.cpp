#include "arm_command.h"

#include "emulated_device.h"
#include "handway/device/arm/arm_emulator.h"
#include "handway/device/arm/tx90_joints.h"
#include "handway/device/arm/val3_arm.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace handway::tools {
namespace {

struct ArmChoice {
  EmulatedDeviceChoice device;
  std::size_t queue = device::Val3ControllerSettings{}.queue;
};

int emulate(const ArmChoice& choice) {
  device::Val3ControllerSettings settings;
  if (choice.device.scene.empty()) {
    settings.joints = device::tx90_joints();
    settings.position = Eigen::VectorXd::Zero(settings.joints.count());
  } else {
    EmulatedPosture posture = scene_posture(choice.device.scene, "arm");
    settings.joints = std::move(posture.joints);
    settings.position = std::move(posture.position);
  }
  settings.lag = 1e-3 * choice.device.lag_ms;
  settings.queue = choice.queue;
  settings.fault = chosen_fault(choice.device);
  const device::ArmEmulator emulator(settings, choice.device.port);
  return serve_device(emulator.address(), choice.device);
}

}  // namespace

void add_arm_command(CLI::App& app, int& exit_code) {
  CLI::App* arm = app.add_subcommand("arm", "Arms: controllers with the VAL3 server");
  arm->require_subcommand(1);
  auto choice = std::make_shared<ArmChoice>();
  choice->device.port = device::kVal3MotionPort;
  choice->device.lag_ms = 1e3 * device::Val3ControllerSettings{}.lag;
  CLI::App* command = arm->add_subcommand(
      "emulate", "Be a TX90 on a CS8 controller; the first line says what to send to");
  add_emulated_device_options(*command, choice->device);
  command->add_option("--queue", choice->queue, "How many points the controller holds")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->callback([choice, &exit_code] { exit_code = emulate(*choice); });
}

}  // namespace handway::tools
