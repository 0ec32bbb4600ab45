#pragma once

#include "widgets/style/theme.h"

#include <QColor>

namespace handway::gui {

/// What needs attention but is no fault: joints at their limits, sensors at their ends.
[[nodiscard]] inline QColor attention_color() {
  return current_theme() == Theme::kDark ? QColor(0xe5, 0xa5, 0x3d) : QColor(0xb9, 0x73, 0x0b);
}

/// `color` with a part of its opacity.
[[nodiscard]] inline QColor faded(QColor color, double opacity) {
  color.setAlphaF(opacity);
  return color;
}

}  // namespace handway::gui
