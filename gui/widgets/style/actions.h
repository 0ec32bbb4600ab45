#pragma once

#include <QString>

class QAction;
class QKeySequence;
class QObject;

namespace handway::gui {

/// Makes a command with its keys, whose tool tip names them. @param name of the object and of its
/// icon, which is for the caller to set; may be empty. @param tip empty: none.
[[nodiscard]] QAction* make_action(QObject& parent, const QString& name, const QString& text,
                                   const QKeySequence& keys, const QString& tip);

/// Enables a command of make_action(), or disables it, with the reason in its tool tip and in the
/// status bar. @param why_not and what to do; empty: it is possible.
void allow(QAction& action, const QString& why_not);

}  // namespace handway::gui
