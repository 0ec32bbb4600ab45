#include "plugin_manager.h"

#include <functional>

namespace handway::python {

const planning::PluginManager& plugin_manager() {
  static const planning::PluginManager& loaded = [] {
    auto* made = new planning::PluginManager;
    made->load_plugins(planning::plugin_directory());
    return std::ref(*made);
  }();
  return loaded;
}

}  // namespace handway::python
