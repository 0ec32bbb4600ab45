#include "handway/planning/extensions/plugin.h"

HANDWAY_PLUGIN({.name = "other_headers", .layout = handway::planning::kPluginLayout + 1});
