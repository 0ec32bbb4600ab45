#pragma once

class SoGroup;

namespace handway::gui {

/// What follows in `group` is drawn in its plain colours, whatever the lights:
/// lines `line_width` and points `point_size` pixels wide.
void add_unlit_style(SoGroup& group, float line_width, float point_size = 1.0F);

}  // namespace handway::gui
