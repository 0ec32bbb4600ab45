#pragma once

#include "handway/geometric/scene/color.h"

namespace handway::gui {

/// Fills the current viewport with a vertical gradient. Needs a current OpenGL
/// context of the compatibility profile; leaves its state as it was.
void draw_backdrop(const geometric::Color& top, const geometric::Color& bottom);

}  // namespace handway::gui
