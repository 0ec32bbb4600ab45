#include "handway/planning/extensions/plugin.h"

#include "ompl_planner.h"

extern "C" __attribute__((visibility("default"))) const handway::planning::Plugin*
handway_plugin() {
  static const handway::planning::Plugin kPlugin = {
      .name = "planner_ompl",
      .version = HANDWAY_VERSION,
      .register_planners = handway::planner_ompl::register_planners};
  return &kPlugin;
}
