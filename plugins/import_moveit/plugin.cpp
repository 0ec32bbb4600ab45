#include "handway/planning/extensions/plugin.h"

#include "moveit_problem.h"

extern "C" __attribute__((visibility("default"))) const handway::planning::Plugin*
handway_plugin() {
  static const handway::planning::Plugin kPlugin = {
      .name = "import_moveit",
      .version = HANDWAY_VERSION,
      .make_importer = []() -> std::unique_ptr<handway::planning::Importer> {
        return std::make_unique<handway::import_moveit::MoveitImporter>();
      }};
  return &kPlugin;
}
