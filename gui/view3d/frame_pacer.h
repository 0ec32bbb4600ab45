#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>

namespace handway::gui {

/// Asks a widget for pictures, but for no more than so many a second: what is asked for sooner
/// comes when its time has come.
class FramePacer {
 public:
  explicit FramePacer(QWidget& widget);

  /// @param frames a second; 0: as many as can be had.
  void set_limit(int frames) { limit_ = frames; }
  [[nodiscard]] int limit() const { return limit_; }
  void request();
  /// A picture is being painted.
  void note_painted();

 private:
  QWidget& widget_;
  QTimer next_;
  QElapsedTimer since_last_;
  int limit_ = 0;
};

}  // namespace handway::gui
