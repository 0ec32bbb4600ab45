#include "widgets/panels/film_bar.h"

#include "widgets/forms/arrangement.h"
#include "widgets/panels/playback_bar.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>

#include <algorithm>
#include <cmath>
#include <utility>

namespace handway::gui {

FilmBar::FilmBar(QWidget* parent)
    : QWidget(parent),
      play_(new QToolButton),
      slider_(new QSlider(Qt::Horizontal)),
      speed_(new QComboBox),
      pictures_(named("film_pictures", new QToolButton)) {
  play_->setAutoRaise(true);
  play_->setIconSize({scaled(20), scaled(20)});
  slider_->setRange(0, 0);
  slider_->setToolTip(tr("Drag to any moment"));
  slider_->setAccessibleName(tr("Moment"));
  offer_speeds(*speed_);
  speed_->setToolTip(tr("Speed; 1× is the speed of the motion"));
  speed_->setAccessibleName(tr("Speed"));
  connect(play_, &QToolButton::clicked, this, [this] { set_playing(!timer_.isActive()); });
  connect(slider_, &QSlider::valueChanged, this, &FilmBar::pause_at);
  connect(speed_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this] { set_playing(timer_.isActive()); });
  connect(&timer_, &QTimer::timeout, this, &FilmBar::go_on);
  play_->setIcon(icon("play"));
  pictures_->setAutoRaise(true);
  pictures_->setIconSize({scaled(20), scaled(20)});
  pictures_->setIcon(icon("camera"));
  pictures_->setToolTip(tr("Save the film as a video or as pictures"));
  pictures_->setAccessibleName(tr("Save the film"));
  connect(pictures_, &QToolButton::clicked, this, [this] {
    set_playing(false);
    emit pictures_wanted();
  });
  lay_out(*this, in_row({play_, {slider_, 1}, speed_, pictures_}, 6));
  setEnabled(false);
}

void FilmBar::begin(int frames) {
  frames_ = frames;
  const QSignalBlocker quiet(slider_);
  slider_->setRange(0, std::max(0, frames - 1));
  setEnabled(is_open());
  if (is_open()) {
    set_playing(true);
    show_frame(0);
  }
}

void FilmBar::pause_at(int frame) {
  set_playing(false);
  show_frame(frame);
}

void FilmBar::end() {
  set_playing(false);
  const QSignalBlocker quiet(slider_);
  slider_->setRange(0, 0);
  setEnabled(false);
  if (std::exchange(frames_, 0) > 0) {
    emit ended();
  }
}

void FilmBar::set_playing(bool playing) {
  const double speed = speed_->currentData().toDouble();
  timer_.setInterval(
      std::max(1, static_cast<int>(std::lround(kFrameTimeMs / std::min(1.0, speed)))));
  playing ? timer_.start() : timer_.stop();
  play_->setIcon(icon(playing ? "pause" : "play"));
  play_->setToolTip(playing ? tr("Pause") : tr("Play"));
}

void FilmBar::go_on() {
  const double speed = speed_->currentData().toDouble();
  const int next = slider_->value() + std::max(1, static_cast<int>(std::lround(speed)));
  next < frames_ ? show_frame(next) : end();
}

void FilmBar::show_frame(int frame) {
  const QSignalBlocker quiet(slider_);
  slider_->setValue(frame);
  emit shown(frame);
}

}  // namespace handway::gui
