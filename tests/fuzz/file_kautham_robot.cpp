/// Robots of Kautham 2013 (XML), without the meshes that they name.
#include "input_file.h"
#include "kautham_robot.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("robot.rob");
  return fuzz::read_or_refuse(
      [&] { static_cast<void>(import_kautham::read_kautham_robot(file.hold(data, size))); });
}
