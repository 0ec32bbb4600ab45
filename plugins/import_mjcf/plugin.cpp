#include "handway/planning/extensions/plugin.h"

#include "mjcf_reader.h"

extern "C" __attribute__((visibility("default"))) const handway::planning::Plugin*
handway_plugin() {
  using handway::geometric::RobotReader;
  static const handway::planning::Plugin kPlugin = {
      .name = "import_mjcf",
      .version = HANDWAY_VERSION,
      .make_robot_readers = []() -> std::vector<RobotReader> {
        return {{"a MuJoCo robot (.xml, .mjcf)", handway::import_mjcf::is_mjcf_file,
                 handway::import_mjcf::read_mjcf}};
      }};
  return &kPlugin;
}
