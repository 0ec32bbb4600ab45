#include "handway/planning/extensions/plugin.h"

HANDWAY_PLUGIN({.api_version = handway::planning::kPluginApiVersion - 1, .name = "old_interface"});
