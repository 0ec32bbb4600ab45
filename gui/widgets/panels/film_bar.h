#pragma once

#include <QTimer>
#include <QWidget>

class QComboBox;
class QSlider;
class QToolButton;

namespace handway::gui {

/// Plays the moments of a simulation or of a planned task, one every 20 ms: a button to play and to
/// pause, a slider to any moment, and the speed.
class FilmBar : public QWidget {
  Q_OBJECT

 public:
  static constexpr int kFrameTimeMs = 20;
  /// Returns the time from the first to the last of some moments, s.
  [[nodiscard]] static double seconds(std::size_t frames) {
    return frames < 2 ? 0.0 : 1e-3 * kFrameTimeMs * static_cast<double>(frames - 1);
  }

  explicit FilmBar(QWidget* parent = nullptr);

  /// Plays moments 0 to `frames` - 1, beginning with the first.
  void begin(int frames);
  /// Shows a moment, at a pause. @pre is_open(), and `frame` is one of the moments.
  void pause_at(int frame);
  /// Shows no moment any more, and can't be used until the next begin().
  void end();
  /// Returns whether moments are shown, playing or at a pause.
  [[nodiscard]] bool is_open() const { return frames_ > 0; }

 signals:
  void shown(int frame);
  /// The last moment is over, or end() was called.
  void ended();
  /// The film is to be saved; it is at a pause.
  void pictures_wanted();

 private:
  void set_playing(bool playing);
  void go_on();
  void show_frame(int frame);

  QToolButton* play_;
  QSlider* slider_;
  QComboBox* speed_;
  QToolButton* pictures_;
  QTimer timer_;
  int frames_ = 0;
};

}  // namespace handway::gui
