/// Recordings of a hand's own joints (tables, messages of ROS).
#include "handway/device/hand/joint_recording.h"
#include "handway/geometric/formats/robot_loader.h"
#include "input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("joints");
  static const auto crane = geometric::load_robot(file.add("crane.urdf", fuzz::kCraneUrdf));
  return fuzz::read_or_refuse(
      [&] { static_cast<void>(device::read_joint_recording(file.hold(data, size), *crane)); });
}
