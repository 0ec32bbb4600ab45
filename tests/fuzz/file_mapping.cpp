/// Mappings of a glove to a hand (YAML).
#include "handway/device/glove/hand_mapping.h"
#include "input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("mapping.yaml");
  return fuzz::read_or_refuse(
      [&] { static_cast<void>(device::read_mapping(file.hold(data, size))); });
}
