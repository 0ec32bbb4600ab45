#include "widgets/style/actions.h"

#include <QAction>
#include <QKeySequence>
#include <QStringList>
#include <QVariant>

namespace handway::gui {
namespace {

constexpr auto kTip = "handway_tip";  // property of commands: what they do

}  // namespace

QAction* make_action(QObject& parent, const QString& name, const QString& text,
                     const QKeySequence& keys, const QString& tip) {
  auto* action = new QAction(text, &parent);
  action->setObjectName(name);
  action->setShortcut(keys);
  if (!tip.isEmpty()) {
    action->setProperty(kTip, tip);
    allow(*action, {});
  }
  return action;
}

void allow(QAction& action, const QString& why_not) {
  const QString tip = action.property(kTip).toString();
  const QString keys = action.shortcut().toString(QKeySequence::NativeText);
  QStringList lines(keys.isEmpty() || tip.isEmpty() ? tip
                                                    : QStringLiteral("%1 (%2)").arg(tip, keys));
  lines << why_not;
  lines.removeAll({});
  action.setToolTip(lines.join(QLatin1Char('\n')));
  action.setStatusTip(why_not.isEmpty() ? tip : why_not.simplified());
  action.setEnabled(why_not.isEmpty());
}

}  // namespace handway::gui
