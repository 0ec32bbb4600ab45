#include "handway/planning/extensions/plugin.h"

#include "val3_exporter.h"

extern "C" __attribute__((visibility("default"))) const handway::planning::Plugin*
handway_plugin() {
  static const handway::planning::Plugin kPlugin = {
      .name = "export_val3", .version = HANDWAY_VERSION, .make_exporters = [] {
        std::vector<std::unique_ptr<handway::planning::Exporter>> exporters;
        exporters.push_back(std::make_unique<handway::export_val3::Val3Exporter>());
        return exporters;
      }};
  return &kPlugin;
}
