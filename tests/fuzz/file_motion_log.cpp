/// Logs of motions (CSV).
#include "handway/execution/motion/motion_log.h"
#include "input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("log.csv");
  return fuzz::read_or_refuse(
      [&] { static_cast<void>(execution::read_motion_log(file.hold(data, size))); });
}
