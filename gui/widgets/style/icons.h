#pragma once

#include <QIcon>
#include <QString>

namespace handway::gui {

/// The icon resources/icons/NAME.svg in the current theme's colours: muted text
/// colour at rest, accent when checked, faint when disabled.
[[nodiscard]] QIcon icon(const QString& name);

/// The same drawing in one given colour.
[[nodiscard]] QIcon icon(const QString& name, const QColor& color);

}  // namespace handway::gui
