#pragma once

#include <QList>
#include <QWidget>

class QComboBox;
class QLabel;
class QMenu;
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

  /// Of what else is drawn of a path.
  [[nodiscard]] QMenu& traces() const { return *traces_; }
  /// Where nothing is drawn but the path.
  void hide_traces();
  /// Draws the icons anew, after a change of theme.
  void refresh_icons();

 private:
  QToolButton* make_button(const QString& name, const QString& tip);
  [[nodiscard]] QList<QToolButton*> buttons() const;
  void show_position();
  void show_timeline();

  PathPlayer& player_;
  QToolButton* back_;
  QToolButton* frame_back_;
  QToolButton* play_;
  QToolButton* frame_forward_;
  QToolButton* forward_;
  QToolButton* loop_;
  QToolButton* reverse_;
  QToolButton* show_;
  QMenu* traces_;
  QSlider* scrub_;
  QLabel* time_;
  QComboBox* speed_;
};

}  // namespace handway::gui
