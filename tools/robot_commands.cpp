#include "commands.h"
#include "emulated_device.h"
#include "handway/device/arm/val3_arm.h"
#include "handway/device/emulators/arm_emulator.h"
#include "handway/device/emulators/hand_emulator.h"
#include "handway/device/emulators/ros_emulator.h"
#include "handway/device/hand/hand_protocol.h"
#include "handway/device/hand/network_hand.h"
#include "handway/device/ros/ros_robot.h"
#include "handway/execution/motion/motion_target.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <utility>

namespace handway::tools {
namespace {

// The joints of the robot's `group` in the named scene, at its start; without a scene those of
// `ours`.
template <typename Settings>
Settings emulator_settings(const EmulatedDeviceChoice& choice, const std::string& group,
                           EmulatedPosture ours) {
  EmulatedPosture posture =
      choice.scene.empty() ? std::move(ours) : scene_posture(choice.scene, group);
  Settings settings;
  settings.joints = std::move(posture.joints);
  settings.position = std::move(posture.position);
  settings.lag = 1e-3 * choice.lag_ms;
  settings.fault = chosen_fault(choice);
  return settings;
}

EmulatedPosture tx90_at_zero() {
  EmulatedPosture posture{device::tx90_joints(), {}};
  posture.position = Eigen::VectorXd::Zero(posture.joints.count());
  return posture;
}

EmulatedPosture open_sah() {
  EmulatedPosture posture{device::sah_joints(), {}};
  posture.position = posture.joints.upper.cwiseMin(0.0);
  return posture;
}

// Adds a group of commands with the one command `emulate`.
CLI::App* add_emulate_command(CLI::App& app, EmulatedDeviceChoice& choice, const char* name,
                              const char* help, const char* emulate_help) {
  CLI::App* group = app.add_subcommand(name, help);
  group->require_subcommand(1);
  CLI::App* command = group->add_subcommand("emulate", emulate_help);
  add_emulated_device_options(*command, choice);
  return command;
}

struct ArmChoice {
  EmulatedDeviceChoice device;
  std::size_t queue = device::Val3ControllerSettings{}.queue;
};

int emulate_arm(const ArmChoice& choice) {
  auto settings =
      emulator_settings<device::Val3ControllerSettings>(choice.device, "arm", tx90_at_zero());
  settings.queue = choice.queue;
  const device::ArmEmulator emulator(settings, choice.device.port);
  return serve_device(emulator.address(), choice.device);
}

int emulate_hand(const EmulatedDeviceChoice& choice) {
  const device::HandEmulator emulator(
      emulator_settings<device::HandControllerSettings>(choice, "hand", open_sah()), choice.port);
  return serve_device(emulator.address(), choice);
}

int emulate_ros(const EmulatedDeviceChoice& choice) {
  const device::RosEmulator emulator(emulator_settings<device::RosControllerSettings>(
                                         choice, execution::kWholeRobot, tx90_at_zero()),
                                     choice.port);
  return serve_device(emulator.address(), choice);
}

}  // namespace

void add_arm_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<ArmChoice>();
  choice->device.port = device::kVal3MotionPort;
  choice->device.lag_ms = 1e3 * device::Val3ControllerSettings{}.lag;
  CLI::App* command = add_emulate_command(
      app, choice->device, "arm", "Emulate an arm: a controller with the VAL3 server",
      "Emulate a TX90 on a CS8 controller; the first line of output is its address");
  command->add_option("--queue", choice->queue, "Number of points that the controller holds")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->callback([choice, &exit_code] { exit_code = emulate_arm(*choice); });
}

void add_hand_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<EmulatedDeviceChoice>();
  choice->port = device::kHandPort;
  choice->lag_ms = 1e3 * device::HandControllerSettings{}.lag;
  add_emulate_command(app, *choice, "hand", "Emulate a hand with Handway's hand protocol",
                      "Emulate an SAH; the first line of output is its address")
      ->callback([choice, &exit_code] { exit_code = emulate_hand(*choice); });
}

void add_ros_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<EmulatedDeviceChoice>();
  choice->port = device::kRosbridgePort;
  choice->lag_ms = 1e3 * device::RosControllerSettings{}.lag;
  add_emulate_command(app, *choice, "ros", "Emulate a robot in ROS behind a rosbridge server",
                      "Emulate a robot in ROS 1 or 2 with its rosbridge server; the first line of "
                      "output is its address")
      ->callback([choice, &exit_code] { exit_code = emulate_ros(*choice); });
}

}  // namespace handway::tools
