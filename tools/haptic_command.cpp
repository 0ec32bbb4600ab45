#include "haptic_command.h"

#include "emulated_device.h"
#include "handway/device/haptic/haptic_emulator.h"
#include "haptic_guide.h"
#include "number_options.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace handway::tools {
namespace {

struct EmulateChoice {
  EmulatedDeviceChoice device;
  double tremble = device::EmulatedHapticSettings{}.tremble;
};

int emulate(const EmulateChoice& choice) {
  device::EmulatedHapticSettings settings;
  settings.tremble = choice.tremble;
  settings.fault = chosen_fault(choice.device);
  const device::HapticEmulator emulator(settings, choice.device.port);
  return serve_device(emulator.address(), choice.device);
}

}  // namespace

void add_haptic_command(CLI::App& app, int& exit_code) {
  CLI::App* haptic = app.add_subcommand("haptic", "Haptic devices: be guided along a path by hand");
  haptic->require_subcommand(1);
  add_haptic_guide(*haptic, exit_code);
  auto choice = std::make_shared<EmulateChoice>();
  choice->device.port = device::kHapticPort;
  CLI::App* command = haptic->add_subcommand(
      "emulate",
      "Be a haptic device with a hand that lets itself be guided; the first line says what to "
      "connect to");
  add_emulator_options(*command, choice->device, {"none", "late", "lost", "refused", "estop"});
  command->add_option("--tremble", choice->tremble, "How strongly the hand trembles, N")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->callback([choice, &exit_code] { exit_code = emulate(*choice); });
}

}  // namespace handway::tools
