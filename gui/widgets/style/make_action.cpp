#include "widgets/style/make_action.h"

#include <QAction>
#include <QKeySequence>

namespace handway::gui {

QAction* make_action(QObject& parent, const QString& name, const QString& text,
                     const QKeySequence& keys, const QString& tip) {
  auto* action = new QAction(text, &parent);
  action->setObjectName(name);
  action->setShortcut(keys);
  if (!tip.isEmpty()) {
    action->setStatusTip(tip);
    const QString shown = keys.toString(QKeySequence::NativeText);
    action->setToolTip(shown.isEmpty() ? tip : QStringLiteral("%1 (%2)").arg(tip, shown));
  }
  return action;
}

}  // namespace handway::gui
