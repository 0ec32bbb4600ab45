#pragma once

#include <QString>

class QColor;

namespace handway::gui {

/// Returns the colour as "#rrggbb", for rich text.
[[nodiscard]] QString html(const QColor& color);

/// Returns plain text as rich text in a colour.
[[nodiscard]] QString colored(const QString& text, const QColor& color);

/// Returns plain text as rich text behind a dot in a colour, which shows a state.
[[nodiscard]] QString dotted(const QString& text, const QColor& color);

}  // namespace handway::gui
