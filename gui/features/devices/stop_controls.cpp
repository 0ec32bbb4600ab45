#include "features/devices/stop_controls.h"

#include <QApplication>
#include <QKeyEvent>
#include <QLayout>
#include <QMouseEvent>
#include <QPushButton>
#include <QVariant>

#include <algorithm>

namespace handway::gui {
namespace {

// Input methods keep Ctrl+Space for themselves, and some keyboards have no Pause. With Ctrl, Pause
// is Break; no other key needs to be held for it, nor for F12.
bool is_stop_key(const QKeyEvent& event) {
  return event.key() == Qt::Key_Pause || event.key() == Qt::Key_Cancel ||
         event.key() == Qt::Key_F12 ||
         (event.key() == Qt::Key_Space && event.modifiers().testFlag(Qt::ControlModifier));
}

bool is_dialog(const QWidget& widget) {
  return widget.isWindow() && (widget.windowType() == Qt::Dialog || widget.isModal());
}

}  // namespace

StopControls::StopControls(QObject* parent) : QObject(parent) {
  QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
  QCoreApplication::setAttribute(Qt::AA_DontUseNativeMenuBar);
  qApp->installEventFilter(this);
}

QString StopControls::keys_text() { return tr("Ctrl+Space, Pause or F12"); }

QPushButton* StopControls::make_button(const QString& name) {
  auto* button = new QPushButton(tr("STOP"));
  button->setObjectName(name);
  button->setProperty("role", "stop");
  button->setToolTip(tr("Stops the robot (%1)").arg(keys_text()));
  // The Tab, Return and Space keys of a dialog must not reach the button.
  button->setFocusPolicy(Qt::NoFocus);
  button->setAutoDefault(false);
  button->setVisible(false);
  connect(button, &QPushButton::pressed, this, &StopControls::stop_requested);
  buttons_.removeAll(nullptr);
  buttons_ << button;
  return button;
}

void StopControls::set_active(bool active) {
  active_ = active;
  for (const QPointer<QPushButton>& button : buttons_) {
    if (button) {
      button->setVisible(active);
    }
  }
}

bool StopControls::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::ShortcutOverride:
    case QEvent::KeyPress:
      if (active_ && is_stop_key(*static_cast<QKeyEvent*>(event))) {
        emit stop_requested();
        event->accept();
        return true;
      }
      break;
    case QEvent::MouseButtonPress:
      // Popups and what is dragged keep the mouse for themselves: the button hears nothing of it.
      if (active_ && watched->isWindowType() &&
          is_at_button(static_cast<QMouseEvent*>(event)->globalPos())) {
        emit stop_requested();
      }
      break;
    case QEvent::Polish:
    case QEvent::Show:
      if (watched->isWidgetType() && is_dialog(*static_cast<QWidget*>(watched))) {
        add_to(*static_cast<QWidget*>(watched));
      }
      break;
    default:
      break;
  }
  return QObject::eventFilter(watched, event);
}

// The strip takes the place of a menu bar, which does not affect the layout's contents and margins.
void StopControls::add_to(QWidget& window) {
  QLayout* layout = window.layout();
  if (!layout || layout->menuBar()) {
    return;
  }
  const QString name = QStringLiteral("stop");
  auto* button = window.findChild<QPushButton*>(name, Qt::FindDirectChildrenOnly);
  if (!button) {
    button = make_button(name);
  }
  layout->setMenuBar(button);
  button->setVisible(active_);
}

bool StopControls::is_at_button(const QPoint& place) const {
  return std::ranges::any_of(buttons_, [&](const QPointer<QPushButton>& button) {
    return button && button->isVisible() && button->rect().contains(button->mapFromGlobal(place)) &&
           QApplication::widgetAt(place) == button;
  });
}

}  // namespace handway::gui
