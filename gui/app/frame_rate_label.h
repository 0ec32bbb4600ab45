#pragma once

#include <QElapsedTimer>
#include <QLabel>
#include <QTimer>

namespace handway::gui {

class SceneView;

/// Says in the status bar how many pictures a second a view draws; nothing while it rests.
class FrameRateLabel : public QLabel {
  Q_OBJECT

 public:
  /// @param view outlives the label.
  explicit FrameRateLabel(SceneView& view, QWidget* parent = nullptr);

 private:
  void count_frame();
  void show_rate();

  SceneView& view_;
  QTimer tick_;
  QElapsedTimer since_;
  int frames_ = 0;
};

}  // namespace handway::gui
