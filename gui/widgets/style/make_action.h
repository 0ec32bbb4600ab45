#pragma once

#include <QString>

class QAction;
class QKeySequence;
class QObject;

namespace handway::gui {

/// A command with its keys, whose tool tip names them. @param name of the object and of its icon,
/// which is for the caller to set; may be empty. @param tip empty: none.
[[nodiscard]] QAction* make_action(QObject& parent, const QString& name, const QString& text,
                                   const QKeySequence& keys, const QString& tip);

}  // namespace handway::gui
