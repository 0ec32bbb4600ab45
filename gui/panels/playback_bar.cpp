#include "panels/playback_bar.h"

#include "style/icons.h"
#include "workers/path_player.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>

#include <cmath>

namespace handway::gui {
namespace {

constexpr int kScrubSteps = 10000;

}  // namespace

PlaybackBar::PlaybackBar(PathPlayer& player, QWidget* parent)
    : QWidget(parent),
      player_(player),
      back_(make_button("step_back", tr("To the waypoint before"))),
      play_(make_button("play", tr("Play or pause the planned path (Space)"))),
      forward_(make_button("step_forward", tr("To the next waypoint"))),
      loop_(make_button("loop", tr("Begin again at the end"))),
      scrub_(new QSlider(Qt::Horizontal)),
      time_(new QLabel),
      speed_(new QComboBox) {
  play_->setShortcut(Qt::Key_Space);
  loop_->setCheckable(true);
  loop_->setChecked(true);
  scrub_->setRange(0, kScrubSteps);
  scrub_->setObjectName(QStringLiteral("scrub"));
  scrub_->setToolTip(tr("Drag along the path"));
  time_->setMinimumWidth(96);
  time_->setAlignment(Qt::AlignCenter);
  time_->setProperty("role", "note");
  for (const double factor : {0.25, 0.5, 1.0, 2.0, 4.0}) {
    speed_->addItem(QStringLiteral("%1×").arg(factor), factor);
  }
  speed_->setCurrentIndex(2);
  speed_->setToolTip(tr("Speed of playing"));

  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(10, 6, 10, 6);
  layout->setSpacing(4);
  for (QWidget* button : {back_, play_, forward_, loop_}) {
    layout->addWidget(button);
  }
  layout->addSpacing(6);
  layout->addWidget(scrub_, 1);
  layout->addWidget(time_);
  layout->addWidget(speed_);

  connect(back_, &QToolButton::clicked, &player_, [this] { player_.step_back(); });
  connect(forward_, &QToolButton::clicked, &player_, [this] { player_.step_forward(); });
  connect(play_, &QToolButton::clicked, &player_,
          [this] { player_.is_playing() ? player_.pause() : player_.play(); });
  connect(loop_, &QToolButton::toggled, &player_, &PathPlayer::set_loop);
  connect(scrub_, &QSlider::valueChanged, &player_, [this](int step) {
    player_.pause();
    player_.seek(static_cast<double>(step) / kScrubSteps);
  });
  connect(speed_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
    player_.set_speed(speed_->currentData().toDouble());
    show_position();
  });
  connect(&player_, &PathPlayer::moved, this, &PlaybackBar::show_position);
  connect(&player_, &PathPlayer::timeline_changed, this, &PlaybackBar::show_timeline);
  connect(&player_, &PathPlayer::playing_changed, this, &PlaybackBar::refresh_icons);
  show_timeline();
}

QToolButton* PlaybackBar::make_button(const QString& name, const QString& tip) {
  auto* button = new QToolButton;
  button->setObjectName(name);
  button->setIcon(icon(name));
  button->setIconSize({20, 20});
  button->setAutoRaise(true);
  button->setToolTip(tip);
  return button;
}

void PlaybackBar::refresh_icons() {
  back_->setIcon(icon("step_back"));
  play_->setIcon(icon(player_.is_playing() ? "pause" : "play"));
  forward_->setIcon(icon("step_forward"));
  loop_->setIcon(icon("loop"));
}

void PlaybackBar::show_position() {
  const QSignalBlocker quiet(scrub_);
  scrub_->setValue(static_cast<int>(std::lround(player_.fraction() * kScrubSteps)));
  if (player_.timeline().empty()) {
    time_->setText(tr("no path yet"));
  } else {
    time_->setText(QStringLiteral("%1 / %2 s")
                       .arg(player_.fraction() * player_.duration(), 0, 'f', 1)
                       .arg(player_.duration(), 0, 'f', 1));
  }
}

void PlaybackBar::show_timeline() {
  const bool ready = !player_.timeline().empty();
  for (QWidget* part : {static_cast<QWidget*>(back_), static_cast<QWidget*>(play_),
                        static_cast<QWidget*>(forward_), static_cast<QWidget*>(scrub_)}) {
    part->setEnabled(ready);
  }
  show_position();
  refresh_icons();
}

}  // namespace handway::gui
