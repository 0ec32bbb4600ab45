#include "model/playback/motion_analysis.h"

#include "model/document/document.h"
#include "model/playback/path_player.h"

#include <exception>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kCalmMs = 120;

}  // namespace

MotionAnalysis::MotionAnalysis(Document& document, PathPlayer& player, QObject* parent)
    : QObject(parent), document_(document), player_(player) {
  calm_.setSingleShot(true);
  calm_.setInterval(kCalmMs);
  connect(&calm_, &QTimer::timeout, this, &MotionAnalysis::time_path);
  connect(&player_, &PathPlayer::timeline_changed, this, &MotionAnalysis::begin);
  connect(&document_, &Document::edited, this, [this](const SceneState& before) {
    if (before.scene != document_.scene()) {
      begin();  // times and clearance are of the scene before
    }
  });
  connect(&document_.recorded_hand(), &RecordedHand::changed, this, [this] {
    if (motion_) {
      find_curves();
    }
  });
}

void MotionAnalysis::begin() {
  job_.cancel();
  motion_.reset();
  problem_.reset();
  curves_.reset();
  fault_.clear();
  const bool has_path = !player_.timeline().empty() && document_.problem();
  state_ = has_path ? State::kTiming : State::kNoPath;
  if (has_path) {
    calm_.start();
  } else {
    calm_.stop();
  }
  emit changed();
}

void MotionAnalysis::time_path() {
  job_.run([this, prepared = document_.problem(),
            path = player_.timeline().path()](const std::stop_token& stop) -> LatestJob::Answer {
    PathMotion timed;
    PreparedProblem::Problem problem;
    try {
      problem = prepared->wait(stop);
      if (!problem) {
        return {};
      }
      timed = motion_of(*problem, path);
    } catch (const std::exception& error) {
      timed.fault = error.what();
    }
    return [this, timed, problem] {
      problem_ = problem;
      take_motion(timed);
      if (timed.motion) {
        find_curves();
      }
    };
  });
}

void MotionAnalysis::take_motion(const PathMotion& timed) {
  motion_ = timed.motion;
  fault_ = QString::fromStdString(timed.fault);
  state_ = motion_ ? State::kTimed : State::kFailed;
  if (motion_) {
    player_.set_motion(motion_);
  }
  emit changed();
}

void MotionAnalysis::find_curves() {
  job_.run([this, problem = problem_, postures = document_.recorded_hand().postures(),
            motion = motion_](const std::stop_token& stop) -> LatestJob::Answer {
    const auto curves = std::make_shared<const MotionCurves>(
        motion_curves(*problem, postures, motion->trajectory, stop));
    return [this, curves] {
      curves_ = curves;
      emit changed();
    };
  });
}

}  // namespace handway::gui
