#include "model/playback/path_player.h"

#include "handway/planning/core/planning_problem.h"
#include "model/playback/path_timeline.h"

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kFrameMs = 33;
constexpr double kRestS = 0.8;  // at the end

}  // namespace

PathPlayer::PathPlayer(QObject* parent) : QObject(parent) {
  timer_.setInterval(kFrameMs);
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, &PathPlayer::advance);
}

void PathPlayer::set_timeline(PathTimeline timeline, const planning::Revision& made_from) {
  pause();
  timeline_ = std::move(timeline);
  made_from_ = made_from;
  fraction_ = 0.0;
  is_at_robot_ = true;
  times_ = Times::kPending;
  emit timeline_changed();
}

void PathPlayer::set_motion(std::shared_ptr<const planning::Motion> motion) {
  const double waypoint = timeline_.waypoint_at(fraction_);
  timeline_.set_motion(std::move(motion));
  fraction_ = timeline_.fraction_at(waypoint);
  times_ = Times::kKnown;
  emit retimed();
}

void PathPlayer::set_times(Times times) {
  if (std::exchange(times_, times) != times) {
    emit retimed();
  }
}

void PathPlayer::locate(const geometric::Configuration& q) {
  constexpr double kSamePlace = 1e-6;  // rad or m
  if (timeline_.empty()) {
    return;
  }
  const auto is_at = [&](double fraction) {
    const geometric::Configuration there = timeline_.at(fraction);
    return there.size() == q.size() && (there - q).lpNorm<Eigen::Infinity>() < kSamePlace;
  };
  const double before = fraction_;
  const bool was_at_robot = is_at_robot_;
  is_at_robot_ = is_at(fraction_);
  for (const double end : {0.0, 1.0}) {
    if (!is_at_robot_ && !is_playing() && is_at(end)) {
      fraction_ = end;
      is_at_robot_ = true;
    }
  }
  if (fraction_ != before || is_at_robot_ != was_at_robot) {
    emit located();
  }
}

void PathPlayer::play() {
  if (timeline_.empty() || is_playing()) {
    return;
  }
  if (fraction_ == end()) {
    fraction_ = begin();
  }
  rest_s_ = 0.0;
  clock_.start();
  timer_.start();
  emit playing_changed(true);
}

void PathPlayer::pause() {
  if (is_playing()) {
    timer_.stop();
    emit playing_changed(false);
  }
}

void PathPlayer::seek(double fraction) {
  if (!timeline_.empty()) {
    fraction_ = std::clamp(fraction, 0.0, 1.0);
    rest_s_ = 0.0;
    emit moved(fraction_);
  }
}

void PathPlayer::step_frames(int frames) {
  pause();
  seek(fraction_ + frames * kFrame / duration());
}

void PathPlayer::advance() {
  const double passed = static_cast<double>(clock_.restart()) * 1e-3;
  if (rest_s_ > 0.0) {
    rest_s_ -= passed;
    if (rest_s_ <= 0.0) {
      fraction_ = begin();
      emit moved(fraction_);
    }
    return;
  }
  const double step = speed_ * passed / duration();
  fraction_ = std::clamp(fraction_ + (backwards_ ? -step : step), 0.0, 1.0);
  emit moved(fraction_);
  if (fraction_ == end()) {
    if (loop_) {
      rest_s_ = kRestS;
    } else {
      pause();
    }
  }
}

}  // namespace handway::gui
