/// Paths (CSV).
#include "handway/geometric/formats/robot_loader.h"
#include "handway/planning/paths/path_file.h"
#include "input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("path.csv");
  static const auto crane = geometric::load_robot(file.add("crane.urdf", fuzz::kCraneUrdf));
  return fuzz::read_or_refuse(
      [&] { static_cast<void>(planning::read_path(*crane, file.hold(data, size))); });
}
