#include "extensions.h"

#include <functional>

namespace handway::python {

const planning::Extensions& extensions() {
  static const planning::Extensions& loaded = [] {
    auto* made = new planning::Extensions;
    made->load_plugins(planning::plugin_directory());
    return std::ref(*made);
  }();
  return loaded;
}

}  // namespace handway::python
