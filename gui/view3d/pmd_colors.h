#pragma once

#include "handway/geometric/scene/color.h"

namespace handway::gui {

/// What a sample is drawn in that used `count` of at most `most` principal motion
/// directions, from blue for few to magenta for many; grey for none.
[[nodiscard]] geometric::Color pmd_color(int count, int most);

}  // namespace handway::gui
