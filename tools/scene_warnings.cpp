#include "scene_warnings.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace handway::tools {

void print_warnings(const geometric::Scene& scene) {
  if (scene.warnings.empty()) {
    return;
  }
  const std::size_t count = scene.warnings.size();
  std::string summary = fmt::format("{} warning{}\n", count, count == 1 ? "" : "s");
  for (const std::string& warning : scene.warnings) {
    summary += fmt::format("  warning: {}\n", warning);
  }
  fmt::print(stderr, "handway: {}", summary);
}

}  // namespace handway::tools
