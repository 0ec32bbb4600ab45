#include "test_plugin.h"

namespace {

const handway::planning::Plugin kPlugin = {.name = "other_headers",
                                           .layout = handway::planning::kPluginLayout + 1};

}  // namespace

HANDWAY_TEST_PLUGIN(kPlugin);
