#include "handway/planning/extensions/plugin.h"

#include "scene_exporters.h"

extern "C" __attribute__((visibility("default"))) const handway::planning::Plugin*
handway_plugin() {
  static const handway::planning::Plugin kPlugin = {
      .name = "export_scene", .version = HANDWAY_VERSION, .make_scene_exporters = []() {
        std::vector<std::unique_ptr<handway::planning::SceneExporter>> exporters;
        exporters.push_back(std::make_unique<handway::export_scene::GltfExporter>());
        exporters.push_back(std::make_unique<handway::export_scene::MoveitSceneExporter>());
        return exporters;
      }};
  return &kPlugin;
}
