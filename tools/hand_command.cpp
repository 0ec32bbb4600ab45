#include "hand_command.h"

#include "emulated_device.h"
#include "handway/device/hand/hand_emulator.h"
#include "handway/device/hand/hand_protocol.h"
#include "handway/device/hand/sah_joints.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace handway::tools {
namespace {

int emulate(const EmulatedDeviceChoice& choice) {
  device::HandControllerSettings settings;
  if (choice.scene.empty()) {
    settings.joints = device::sah_joints();
    settings.position = settings.joints.upper.cwiseMin(0.0);
  } else {
    EmulatedPosture posture = scene_posture(choice.scene, "hand");
    settings.joints = std::move(posture.joints);
    settings.position = std::move(posture.position);
  }
  settings.lag = 1e-3 * choice.lag_ms;
  settings.fault = chosen_fault(choice);
  const device::HandEmulator emulator(settings, choice.port);
  return serve_device(emulator.address(), choice);
}

}  // namespace

void add_hand_command(CLI::App& app, int& exit_code) {
  CLI::App* hand = app.add_subcommand("hand", "Hands that speak Handway's hand protocol");
  hand->require_subcommand(1);
  auto choice = std::make_shared<EmulatedDeviceChoice>();
  choice->port = device::kHandPort;
  choice->lag_ms = 1e3 * device::HandControllerSettings{}.lag;
  CLI::App* command =
      hand->add_subcommand("emulate", "Be an SAH; the first line says what to send to");
  add_emulated_device_options(*command, *choice);
  command->callback([choice, &exit_code] { exit_code = emulate(*choice); });
}

}  // namespace handway::tools
