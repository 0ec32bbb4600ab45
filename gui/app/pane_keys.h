#pragma once

#include <QObject>

class QMainWindow;
class QWidget;

namespace handway::gui {

/// F6 and Shift+F6 move the keyboard to the next and the previous pane of a window: the view, each
/// dock that is shown, the playback bar.
class PaneKeys : public QObject {
 public:
  /// All outlive this.
  PaneKeys(QMainWindow& window, QWidget& view, QWidget& playback);

 private:
  void step(int direction);

  QMainWindow& window_;
  QWidget& view_;
  QWidget& playback_;
};

}  // namespace handway::gui
