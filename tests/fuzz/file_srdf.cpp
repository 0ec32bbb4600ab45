/// Groups, states and allowed collisions of a robot (SRDF).
#include "handway/geometric/formats/srdf.h"
#include "handway/geometric/formats/urdf.h"
#include "input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("groups.srdf");
  static const geometric::RobotDescription crane =
      geometric::read_urdf(file.add("crane.urdf", fuzz::kCraneUrdf));
  return fuzz::read_or_refuse([&] {
    geometric::RobotDescription robot = crane;
    geometric::read_srdf(file.hold(data, size), robot);
  });
}
