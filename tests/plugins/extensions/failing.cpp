#include "test_plugin.h"

#include <stdexcept>

namespace {

const handway::planning::Plugin kPlugin = {
    .name = "failing", .register_planners = [](handway::planning::PlannerRegistry& registry) {
      registry.add("half-done", [] { return nullptr; });
      throw std::runtime_error("no licence for half-done");
    }};

}  // namespace

HANDWAY_TEST_PLUGIN(kPlugin);
