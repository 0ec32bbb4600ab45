#pragma once

#include <QFrame>

namespace handway::gui {

/// A frame that floats over a widget and keeps its place when that one is resized.
/// It is hidden until it appears.
class FloatingCard : public QFrame {
  Q_OBJECT

 public:
  explicit FloatingCard(QWidget* host);

 protected:
  /// Shows it in its place, over the others.
  void appear();
  /// Sets the geometry in the host's coordinates; called whenever the host is resized.
  virtual void place() = 0;
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace handway::gui
