/// MoveIt scenes and requests (YAML): an input is a scene and, behind a line "---", a request.
#include "input_file.h"
#include "moveit_problem.h"

#include <algorithm>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace handway;
  static const fuzz::InputFile file("scene0001.yaml");
  static const auto crane = file.add("crane.urdf", fuzz::kCraneUrdf);
  static const auto groups = file.add("crane.srdf", fuzz::kCraneSrdf);
  constexpr std::string_view kBetween = "\n---\n";
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t scene = std::min(text.find(kBetween), size);
  import_moveit::ProblemFiles files{file.hold(data, scene), std::nullopt};
  if (scene < size) {
    files.request = file.add("request0001.yaml", text.substr(scene + kBetween.size()));
  }
  return fuzz::read_or_refuse(
      [&] { static_cast<void>(import_moveit::read_moveit_problem(files)); });
}
