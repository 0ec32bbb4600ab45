#pragma once

#include <QIcon>
#include <QString>

class QAction;
class QKeySequence;
class QObject;

namespace handway::gui {

/// The icon resources/icons/NAME.svg in the current theme's colours: muted text
/// colour at rest, accent when checked, faint when disabled.
[[nodiscard]] QIcon icon(const QString& name);

/// The same drawing in one given colour.
[[nodiscard]] QIcon icon(const QString& name, const QColor& color);

/// A command with its keys, whose tool tip names them. @param name of the object and of its icon,
/// which is for the caller to set; may be empty. @param tip empty: none.
[[nodiscard]] QAction* make_action(QObject& parent, const QString& name, const QString& text,
                                   const QKeySequence& keys, const QString& tip);

}  // namespace handway::gui
