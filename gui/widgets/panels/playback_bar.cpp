#include "widgets/panels/playback_bar.h"

#include "model/playback/path_player.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QShortcut>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>

#include <cmath>

namespace handway::gui {

void offer_speeds(QComboBox& box) {
  for (const double factor : {0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0}) {
    box.addItem(QStringLiteral("%1×").arg(factor), factor);
  }
  box.setCurrentIndex(box.findData(1.0));
}

namespace {

constexpr int kScrubSteps = 10000;
constexpr int kLeastScrub = 160;  // px, for a timeline that can be used

QString time_text(const PathPlayer& player) {
  if (player.times() == PathPlayer::Times::kPending) {
    return QObject::tr("timing…");
  }
  const QString duration = (player.times() == PathPlayer::Times::kKnown ? QStringLiteral("%1 s")
                                                                        : QObject::tr("about %1 s"))
                               .arg(player.duration(), 0, 'f', 2);
  return player.is_at_robot()
             ? QStringLiteral("%1 / %2").arg(player.time(), 0, 'f', 2).arg(duration)
             : QObject::tr("off path / %1").arg(duration);
}

}  // namespace

PlaybackBar::PlaybackBar(PathPlayer& player, QWidget* parent)
    : QWidget(parent),
      player_(player),
      back_(make_button("step_back", tr("To the start of the path"))),
      frame_back_(make_button("frame_back", tr("Previous frame (,)"))),
      play_(make_button("play", tr("Play or pause the planned path (Space)"))),
      frame_forward_(make_button("frame_forward", tr("Next frame (.)"))),
      forward_(make_button("step_forward", tr("To the end of the path"))),
      loop_(make_button("loop", tr("Repeat"))),
      reverse_(make_button("reverse", tr("Play backwards"))),
      show_(make_button("traces", tr("Path display"))),
      traces_(new QMenu(this)),
      above_(new QHBoxLayout),
      row_(new QHBoxLayout),
      scrub_(named("scrub", new QSlider(Qt::Horizontal))),
      note_(named("playback_note", note())),
      time_(named("playback_time", note())),
      speed_(named("speed", new QComboBox)),
      space_(new QShortcut(Qt::Key_Space, this)) {
  // A shortcut of the button itself would press it twice where it has the focus.
  connect(space_, &QShortcut::activated, play_, &QAbstractButton::click);
  frame_back_->setShortcut(Qt::Key_Comma);
  frame_forward_->setShortcut(Qt::Key_Period);
  reverse_->setCheckable(true);
  loop_->setCheckable(true);
  loop_->setChecked(true);
  scrub_->setRange(0, kScrubSteps);
  scrub_->setToolTip(tr("Drag along the path"));
  time_->setMinimumWidth(scaled(86));
  time_->setAlignment(Qt::AlignCenter);
  note_->hide();
  offer_speeds(*speed_);
  speed_->setToolTip(tr("Playback speed; 1× is the robot's full speed"));
  show_->setPopupMode(QToolButton::InstantPopup);
  show_->setMenu(traces_);
  traces_->setToolTipsVisible(true);

  lay_out(*this, in_column({above_, row_}, 2), {8, 6, 8, 6});
  row_->setSpacing(4);
  for (QToolButton* button : buttons()) {
    row_->addWidget(button);
  }
  row_->addSpacing(6);
  row_->addStretch();
  row_->addWidget(speed_);
  row_->addWidget(show_);
  above_->addWidget(scrub_, 1);
  above_->addWidget(note_);
  above_->addWidget(time_);

  connect(back_, &QToolButton::clicked, &player_, [this] { go_to(0.0); });
  connect(forward_, &QToolButton::clicked, &player_, [this] { go_to(1.0); });
  connect(new QShortcut(Qt::Key_BracketLeft, this), &QShortcut::activated, &player_,
          [this] { player_.step_back(); });
  connect(new QShortcut(Qt::Key_BracketRight, this), &QShortcut::activated, &player_,
          [this] { player_.step_forward(); });
  connect(frame_back_, &QToolButton::clicked, &player_, [this] { player_.step_frames(-1); });
  connect(frame_forward_, &QToolButton::clicked, &player_, [this] { player_.step_frames(1); });
  connect(reverse_, &QToolButton::toggled, &player_, &PathPlayer::set_backwards);
  connect(play_, &QToolButton::clicked, &player_,
          [this] { player_.is_playing() ? player_.pause() : play(); });
  connect(speed_, qOverload<int>(&QComboBox::activated), this,
          [this] { has_chosen_speed_ = true; });
  connect(loop_, &QToolButton::toggled, &player_, &PathPlayer::set_loop);
  connect(scrub_, &QSlider::valueChanged, &player_, [this](int step) {
    player_.pause();
    player_.seek(static_cast<double>(step) / kScrubSteps);
  });
  connect(speed_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this] { player_.set_speed(speed_->currentData().toDouble()); });
  connect(&player_, &PathPlayer::moved, this, &PlaybackBar::show_position);
  connect(&player_, &PathPlayer::retimed, this, &PlaybackBar::show_position);
  connect(&player_, &PathPlayer::retimed, this, [this] {
    if (player_.is_playing()) {
      slow_down();  // it began before the times were known
    }
  });
  connect(&player_, &PathPlayer::located, this, &PlaybackBar::show_position);
  connect(&player_, &PathPlayer::timeline_changed, this, &PlaybackBar::show_timeline);
  connect(&player_, &PathPlayer::playing_changed, this, &PlaybackBar::refresh_icons);
  show_timeline();
}

void PlaybackBar::go_to(double fraction) {
  player_.pause();
  player_.seek(fraction);
}

void PlaybackBar::play() {
  slow_down();
  player_.play();
}

// Motions of robots are often over before one has looked at them.
void PlaybackBar::slow_down() {
  constexpr double kLeast = 3.0;  // s
  if (has_chosen_speed_ || player_.times() != PathPlayer::Times::kKnown) {
    return;
  }
  int slowest_needed = speed_->findData(1.0);
  while (slowest_needed > 0 &&
         player_.duration() < kLeast * speed_->itemData(slowest_needed).toDouble()) {
    --slowest_needed;
  }
  has_chosen_speed_ = true;
  if (slowest_needed != speed_->currentIndex()) {
    speed_->setCurrentIndex(slowest_needed);
    emit slowed_down(tr("Played at %1 at first, because the motion takes %2 s. The field beside "
                        "the timeline changes the speed.")
                         .arg(speed_->currentText())
                         .arg(player_.duration(), 0, 'f', 2));
  }
}

QToolButton* PlaybackBar::make_button(const QString& name, const QString& tip) {
  auto* button = new QToolButton;
  button->setObjectName(name);
  button->setIcon(icon(name));
  button->setIconSize({20, 20});  // larger ones would not fit beside large text
  button->setAutoRaise(true);
  button->setToolTip(tip);
  return button;
}

void PlaybackBar::show_note(const QString& note, const QString& explanation) {
  note_->setText(note);
  note_->setToolTip(explanation);
  note_->setVisible(!note.isEmpty());
  share_room();
}

// Beside a timeline above the buttons there is room for one of them.
void PlaybackBar::share_room() { time_->setVisible(above_->isEmpty() || note_->text().isEmpty()); }

void PlaybackBar::hide_traces() { show_->hide(); }

QList<QToolButton*> PlaybackBar::buttons() const {
  return {back_, frame_back_, play_, frame_forward_, forward_, reverse_, loop_};
}

QList<QToolButton*> PlaybackBar::spare_buttons() const {
  return {frame_back_, frame_forward_, reverse_};
}

int PlaybackBar::width_of(const QToolButton& button) const {
  return button.minimumSizeHint().width() + row_->spacing();
}

// Returns the size of a bar with the timeline above and without the spare buttons.
QSize PlaybackBar::minimumSizeHint() const {
  QSize size = QWidget::minimumSizeHint();
  if (above_->isEmpty()) {
    for (const QWidget* part :
         {static_cast<const QWidget*>(scrub_), static_cast<const QWidget*>(note_),
          static_cast<const QWidget*>(time_)}) {
      size.rwidth() -= part->isHidden() ? 0 : part->minimumSizeHint().width() + row_->spacing();
    }
  }
  for (const QToolButton* button : spare_buttons()) {
    size.rwidth() -= button->isHidden() ? 0 : width_of(*button);
  }
  return size;
}

void PlaybackBar::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  int needed = minimumSizeHint().width();
  for (const QToolButton* button : spare_buttons()) {
    needed += width_of(*button);
  }
  for (QToolButton* button : spare_buttons()) {
    button->setVisible(width() >= needed);
  }
  put_scrub(width() < needed + time_->minimumSizeHint().width() + kLeastScrub);
}

void PlaybackBar::put_scrub(bool above) {
  if (above == above_->isEmpty()) {
    int place = above ? 0 : row_->indexOf(buttons().last()) + 2;
    QBoxLayout* const row = above ? above_ : row_;
    for (QWidget* part : {static_cast<QWidget*>(scrub_), static_cast<QWidget*>(note_),
                          static_cast<QWidget*>(time_)}) {
      row_->removeWidget(part);
      above_->removeWidget(part);
      row->insertWidget(place++, part, part == scrub_ ? 1 : 0);
    }
    share_room();
  }
}

void PlaybackBar::refresh_icons() {
  for (QToolButton* button : buttons()) {
    button->setIcon(icon(button->objectName()));
  }
  show_->setIcon(icon("traces"));
  play_->setIcon(icon(player_.is_playing() ? "pause" : "play"));
}

void PlaybackBar::show_position() {
  const QSignalBlocker quiet(scrub_);
  scrub_->setValue(static_cast<int>(std::lround(player_.fraction() * kScrubSteps)));
  if (player_.timeline().empty()) {
    time_->setText(tr("no path yet"));
  } else {
    time_->setText(time_text(player_));
  }
}

void PlaybackBar::show_timeline() {
  const bool ready = !player_.timeline().empty();
  for (QToolButton* button : {back_, frame_back_, play_, frame_forward_, forward_}) {
    button->setEnabled(ready);
  }
  space_->setEnabled(ready);
  scrub_->setEnabled(ready);
  show_position();
  refresh_icons();
}

}  // namespace handway::gui
