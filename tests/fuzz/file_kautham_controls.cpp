/// Controls of Kautham's later versions (XML), for two robots.
#include "input_file.h"
#include "kautham_robot.h"

#include <array>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("robots.cntr");
  std::array<import_kautham::KauthamRobot, 2> robots;
  robots[0].name = "arm";
  robots[1].name = "arm/hand";
  for (import_kautham::KauthamRobot& robot : robots) {
    robot.joints.resize(2);
    robot.joints[1].name = "Elbow";
  }
  return fuzz::read_or_refuse(
      [&] { import_kautham::read_kautham_controls(file.hold(data, size), robots); });
}
