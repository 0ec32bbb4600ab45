#include "widgets/forms/wheel_guard.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QSlider>
#include <QWidget>

namespace handway::gui {
namespace {

QWidget* changed_by_wheel(QObject* object) {
  const bool is_one = qobject_cast<QAbstractSpinBox*>(object) || qobject_cast<QSlider*>(object) ||
                      qobject_cast<QComboBox*>(object);
  return is_one ? static_cast<QWidget*>(object) : nullptr;
}

}  // namespace

WheelGuard::WheelGuard(QObject* parent) : QObject(parent) { qApp->installEventFilter(this); }

bool WheelGuard::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Polish) {
    if (QWidget* widget = changed_by_wheel(watched);
        widget && widget->focusPolicy() == Qt::WheelFocus) {
      widget->setFocusPolicy(Qt::StrongFocus);  // else the wheel gives the focus first
    }
  } else if (event->type() == QEvent::Wheel) {
    if (const QWidget* widget = changed_by_wheel(watched); widget && !widget->hasFocus()) {
      event->ignore();  // the parent scrolls
      return true;
    }
  }
  return QObject::eventFilter(watched, event);
}

}  // namespace handway::gui
