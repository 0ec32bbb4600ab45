/// Scenes (YAML).
#include "handway/geometric/formats/scene_file.h"
#include "input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("scene.yaml");
  static const auto crane = file.add("crane.urdf", fuzz::kCraneUrdf);
  return fuzz::read_or_refuse(
      [&] { static_cast<void>(geometric::read_scene(file.hold(data, size))); });
}
