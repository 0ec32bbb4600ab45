/// Recordings in bags of ROS 1.
#include "handway/device/recordings/recorded_table.h"
#include "handway/device/recordings/recording_contents.h"
#include "input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("bag.bag");
  const std::filesystem::path& held = file.hold(data, size);
  return fuzz::read_or_refuse([&] {
    static_cast<void>(device::recording_contents(held));
    static_cast<void>(device::read_recorded_table(held));
  });
}
