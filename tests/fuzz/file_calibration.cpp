/// Calibrations of a glove (YAML and the text files of VirtualHand).
#include "handway/device/glove/glove_calibration.h"
#include "input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("calibration.yaml");
  return fuzz::read_or_refuse(
      [&] { static_cast<void>(device::read_calibration(file.hold(data, size))); });
}
