#pragma once

#include <QObject>

namespace handway::gui {

/// Keeps the wheel from changing sliders, number fields and choices over which it merely happens
/// to scroll: it changes only those that have the focus, and goes on to what scrolls otherwise.
class WheelGuard : public QObject {
  Q_OBJECT

 public:
  /// Watches all widgets of the program for as long as it lives.
  explicit WheelGuard(QObject* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace handway::gui
