#include "handway/planning/extensions/plugin.h"

#include "ros_exporter.h"

extern "C" __attribute__((visibility("default"))) const handway::planning::Plugin*
handway_plugin() {
  static const handway::planning::Plugin kPlugin = {
      .name = "export_ros", .version = HANDWAY_VERSION, .make_exporters = [] {
        std::vector<std::unique_ptr<handway::planning::Exporter>> exporters;
        exporters.push_back(std::make_unique<handway::export_ros::RosExporter>());
        exporters.push_back(std::make_unique<handway::export_ros::MoveItExporter>());
        return exporters;
      }};
  return &kPlugin;
}
