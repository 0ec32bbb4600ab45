/// Output of a VAL3 server, and input of an emulated controller: simple_message.
#include "handway/device/arm/simple_message.h"
#include "handway/device/arm/val3_arm.h"
#include "handway/device/emulators/arm_emulator.h"
#include "pieces.h"

#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  device::SimpleMessageParser parser;
  device::Val3ControllerSettings settings;
  settings.joints = device::tx90_joints();
  settings.position = Eigen::VectorXd::Zero(6);
  device::Val3Controller controller(settings);
  double now = 0.0;
  try {
    fuzz::in_pieces(data, size, [&](fuzz::Bytes bytes) {
      parser.add(bytes);
      while (const auto message = parser.next()) {
        for (const float joint : message->joints) {
          fuzz::require(std::isfinite(joint));
        }
        static_cast<void>(encode(controller.receive(*message, now)));
        controller.advance(now += 0.02);
        fuzz::require(controller.position().allFinite());
      }
    });
  } catch (const device::SimpleMessageError&) {
    return 0;
  }
  return 0;
}
