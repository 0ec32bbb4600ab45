#include "ros_command.h"

#include "emulated_device.h"
#include "handway/device/arm/tx90_joints.h"
#include "handway/device/ros/ros_emulator.h"
#include "handway/device/ros/ros_robot.h"
#include "handway/execution/motion/motion_target.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace handway::tools {
namespace {

int emulate(const EmulatedDeviceChoice& choice) {
  device::RosControllerSettings settings;
  if (choice.scene.empty()) {
    settings.joints = device::tx90_joints();
    settings.position = Eigen::VectorXd::Zero(settings.joints.count());
  } else {
    EmulatedPosture posture = scene_posture(choice.scene, execution::kWholeRobot);
    settings.joints = std::move(posture.joints);
    settings.position = std::move(posture.position);
  }
  settings.lag = 1e-3 * choice.lag_ms;
  settings.fault = chosen_fault(choice);
  const device::RosEmulator emulator(settings, choice.port);
  return serve_device(emulator.address(), choice);
}

}  // namespace

void add_ros_command(CLI::App& app, int& exit_code) {
  CLI::App* ros = app.add_subcommand("ros", "Robots in ROS, behind a rosbridge server");
  ros->require_subcommand(1);
  auto choice = std::make_shared<EmulatedDeviceChoice>();
  choice->port = device::kRosbridgePort;
  choice->lag_ms = 1e3 * device::RosControllerSettings{}.lag;
  CLI::App* command = ros->add_subcommand(
      "emulate",
      "Be a robot in ROS 1 or 2 with its rosbridge server; the first line says what to send to");
  add_emulated_device_options(*command, *choice);
  command->callback([choice, &exit_code] { exit_code = emulate(*choice); });
}

}  // namespace handway::tools
