#pragma once

#include "view3d/coin_ref.h"

class SoSeparator;

namespace handway::gui {

/// Three unit arrows from the origin: x red, y green, z blue.
[[nodiscard]] CoinRef<SoSeparator> make_axes_node();

}  // namespace handway::gui
