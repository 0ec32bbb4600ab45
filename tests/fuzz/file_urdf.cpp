/// Robots (URDF).
#include "handway/geometric/formats/robot_loader.h"
#include "input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("robot.urdf");
  return fuzz::read_or_refuse(
      [&] { static_cast<void>(geometric::load_robot(file.hold(data, size))); });
}
