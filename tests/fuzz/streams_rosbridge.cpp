/// Messages of rosbridge, one a line: what a robot sends, and what an emulated one is sent.
#include "handway/device/arm/val3_arm.h"
#include "handway/device/emulators/ros_emulator.h"
#include "handway/device/ros/rosbridge.h"
#include "pieces.h"

#include <algorithm>
#include <string>
#include <utility>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  device::RosControllerSettings settings;
  settings.joints = device::tx90_joints();
  settings.position = Eigen::VectorXd::Zero(6);
  device::RosController robot(settings);
  double now = 0.0;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  while (!rest.empty()) {
    const std::string text(rest.substr(0, rest.find('\n')));
    rest.remove_prefix(std::min(rest.size(), text.size() + 1));
    try {
      const device::RosbridgeMessage message = device::parse_rosbridge(text);
      if (message.joint_state) {
        fuzz::require(std::cmp_equal(message.joint_state->names.size(),
                                     message.joint_state->position.size()));
      }
    } catch (const device::RosbridgeError& error) {
      fuzz::require(std::string(error.what()).size() < 400);
    }
    static_cast<void>(robot.receive(1, text, now));
    robot.advance(now += 0.01);
    static_cast<void>(robot.feedback(1));
    fuzz::require(robot.position().allFinite());
  }
  return 0;
}
