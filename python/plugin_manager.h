#pragma once

#include "handway/planning/extensions/plugin.h"

namespace handway::python {

/// The planners and file formats of this process: built-in ones and those of the plugins,
/// from $HANDWAY_PLUGIN_DIR, or handway-plugins beside the libraries. Loaded when first asked
/// for; kept to the end, because Python may hold their objects until then.
[[nodiscard]] const planning::PluginManager& plugin_manager();

}  // namespace handway::python
