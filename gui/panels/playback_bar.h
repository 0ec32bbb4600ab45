#pragma once

#include <QWidget>

class QComboBox;
class QLabel;
class QSlider;
class QToolButton;

namespace handway::gui {

class PathPlayer;

/// Buttons and a scrub slider for a path player.
class PlaybackBar : public QWidget {
  Q_OBJECT

 public:
  /// @param player outlives the bar.
  explicit PlaybackBar(PathPlayer& player, QWidget* parent = nullptr);

  /// Draws the icons anew, after a change of theme.
  void refresh_icons();

 private:
  QToolButton* make_button(const QString& name, const QString& tip);
  void show_position();
  void show_timeline();

  PathPlayer& player_;
  QToolButton* back_;
  QToolButton* play_;
  QToolButton* forward_;
  QToolButton* loop_;
  QSlider* scrub_;
  QLabel* time_;
  QComboBox* speed_;
};

}  // namespace handway::gui
