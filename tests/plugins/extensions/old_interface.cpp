#include "test_plugin.h"

namespace {

const handway::planning::Plugin kPlugin = {.api_version = handway::planning::kPluginApiVersion - 1,
                                           .name = "old_interface"};

}  // namespace

HANDWAY_TEST_PLUGIN(kPlugin);
