#pragma once

#include <QList>
#include <QWidget>

class QBoxLayout;
class QComboBox;
class QLabel;
class QMenu;
class QShortcut;
class QSlider;
class QToolButton;

namespace handway::gui {

class PathPlayer;

/// Offers speeds from a tenth to ten times real time, each item's data the factor; real time is
/// chosen.
void offer_speeds(QComboBox& box);

/// Buttons and a scrub slider for a path player. If there is little room, the slider is above the
/// buttons, and buttons that have a key are left out.
class PlaybackBar : public QWidget {
  Q_OBJECT

 public:
  /// @param player outlives the bar.
  explicit PlaybackBar(PathPlayer& player, QWidget* parent = nullptr);

  /// Plays the path; a first motion of less than 3 s slower, unless a speed was chosen.
  void play();
  /// Menu of the traces of a path.
  [[nodiscard]] QMenu& traces() const { return *traces_; }
  /// A word about what is played; empty: none.
  void show_note(const QString& note, const QString& explanation);
  /// Hides the traces, so that only the path is drawn.
  void hide_traces();
  /// Redraws the icons, after a change of theme.
  void refresh_icons();

  /// Returns the smallest size, without the buttons that can be left out.
  [[nodiscard]] QSize minimumSizeHint() const override;

 signals:
  /// The first motion was too short to be looked at, and is played slower.
  void slowed_down(const QString& message);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QToolButton* make_button(const QString& name, const QString& tip);
  void go_to(double fraction);
  void slow_down();
  [[nodiscard]] QList<QToolButton*> buttons() const;
  [[nodiscard]] QList<QToolButton*> spare_buttons() const;
  /// px, with the space before it.
  [[nodiscard]] int width_of(const QToolButton& button) const;
  void show_position();
  void show_timeline();
  void put_scrub(bool above);
  void share_room();

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
  QBoxLayout* above_;  ///< Layout of the buttons.
  QBoxLayout* row_;
  QSlider* scrub_;
  QLabel* note_;
  QLabel* time_;
  QComboBox* speed_;
  QShortcut* space_;
  bool has_chosen_speed_ = false;  ///< The speed is the user's, or was reduced once.
};

}  // namespace handway::gui
