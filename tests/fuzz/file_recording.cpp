/// Recordings of a glove (CSV and the logs of VirtualHand).
#include "handway/device/glove/recording.h"
#include "input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("recording.csv");
  return fuzz::read_or_refuse(
      [&] { static_cast<void>(device::read_recording(file.hold(data, size))); });
}
