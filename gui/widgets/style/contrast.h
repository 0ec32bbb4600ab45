#pragma once

#include <QColor>

namespace handway::gui {

/// The ratio of two colours' luminances, 1 to 21, as the Web Content Accessibility Guidelines 2.1
/// define it.
[[nodiscard]] double contrast(const QColor& a, const QColor& b);

/// `color`, lighter or darker if it could hardly be told from `background`.
[[nodiscard]] QColor seen_on(const QColor& background, const QColor& color);

}  // namespace handway::gui
