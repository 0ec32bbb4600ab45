#pragma once

#include <QCoreApplication>
#include <QMouseEvent>
#include <QWidget>

namespace handway::test {

/// Moves the mouse with its left button held down. Unlike QTest::mouseMove() it leaves the
/// screen's own pointer alone, which all tests on that screen share.
inline void move_pressed_mouse(QWidget& widget, const QPoint& to) {
  QMouseEvent move(QEvent::MouseMove, to, widget.mapToGlobal(to), Qt::NoButton, Qt::LeftButton,
                   Qt::NoModifier);
  QCoreApplication::sendEvent(&widget, &move);
}

}  // namespace handway::test
