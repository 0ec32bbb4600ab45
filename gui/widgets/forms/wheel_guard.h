#pragma once

#include <QObject>

namespace handway::gui {

/// Prevents the wheel from changing sliders, number fields and choices that it merely scrolls over:
/// it changes only those that have the focus, and otherwise scrolls.
class WheelGuard : public QObject {
  Q_OBJECT

 public:
  /// Watches all widgets of the program for as long as it lives.
  explicit WheelGuard(QObject* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace handway::gui
