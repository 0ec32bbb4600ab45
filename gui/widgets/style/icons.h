#pragma once

#include <QIcon>
#include <QString>

class QColor;

namespace handway::gui {

/// Returns the icon resources/icons/NAME.svg in the current theme's colours: muted text colour at
/// rest, accent when checked, faint when disabled.
[[nodiscard]] QIcon icon(const QString& name);

/// Returns the icon in one given colour.
[[nodiscard]] QIcon icon(const QString& name, const QColor& color);

}  // namespace handway::gui
