#pragma once

#include <QColor>

namespace handway::gui {

/// Returns `from`, with a share of its way to `to`.
[[nodiscard]] QColor mixed(const QColor& from, const QColor& to, double share);

/// Returns `color` with a part of its opacity.
[[nodiscard]] inline QColor faded(QColor color, double opacity) {
  color.setAlphaF(opacity);
  return color;
}

/// Returns the ratio of two colours' luminances, 1 to 21, as the Web Content Accessibility
/// Guidelines 2.1 define it.
[[nodiscard]] double contrast(const QColor& a, const QColor& b);

/// Returns `color`, lighter or darker if it could hardly be distinguished from `background`.
[[nodiscard]] QColor seen_on(const QColor& background, const QColor& color);

}  // namespace handway::gui
