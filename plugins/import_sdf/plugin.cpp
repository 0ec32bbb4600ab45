#include "handway/planning/extensions/plugin.h"

#include "sdf_reader.h"

extern "C" __attribute__((visibility("default"))) const handway::planning::Plugin*
handway_plugin() {
  using handway::geometric::RobotReader;
  static const handway::planning::Plugin kPlugin = {
      .name = "import_sdf",
      .version = HANDWAY_VERSION,
      .make_robot_readers = []() -> std::vector<RobotReader> {
        return {{"an SDF model (.sdf)", handway::import_sdf::is_sdf_file,
                 handway::import_sdf::read_sdf}};
      }};
  return &kPlugin;
}
