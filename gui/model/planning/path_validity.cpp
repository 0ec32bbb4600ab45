#include "model/planning/path_validity.h"

#include "handway/planning/paths/path_check.h"
#include "model/playback/path_player.h"
#include "model/playback/path_timeline.h"

#include <optional>
#include <utility>

namespace handway::gui {
namespace {

QString text_of(const planning::PathConflict& conflict, const PathTimeline& timeline,
                bool was_valid) {
  const double waypoint = static_cast<double>(conflict.waypoint) + conflict.share;
  // Without a motion there are no times.
  const QString where =
      timeline.motion() ? QObject::tr("at %1 s of the path")
                              .arg(timeline.fraction_at(waypoint) * timeline.duration(), 0, 'f', 2)
                        : QObject::tr("after waypoint %1").arg(conflict.waypoint + 1);
  return (was_valid ? QObject::tr("Out of date, the scene was edited: %1 %2.")
                    : QObject::tr("Not valid in this scene: %1 %2."))
      .arg(QString::fromStdString(conflict.text), where);
}

}  // namespace

PathValidity::PathValidity(PathPlayer& player, QObject* parent) : QObject(parent), player_(player) {
  connect(&player_, &PathPlayer::timeline_changed, this, &PathValidity::look);
  connect(&job_, &LatestJob::failed, this,
          [this](const QString& message) { set(State::kInvalid, message); });
}

void PathValidity::follow(std::shared_ptr<const PreparedProblem> scene) {
  scene_ = std::move(scene);
  look();
}

void PathValidity::set(State state, const QString& reason) {
  state_ = state;
  reason_ = reason;
  emit changed();
}

void PathValidity::look() {
  job_.cancel();
  if (player_.timeline().empty() || !scene_) {
    set(State::kNoPath);
  } else if (player_.made_from() == scene_->revision()) {
    set(State::kValid);
  } else {
    set(State::kOutOfDate, was_valid()
                               ? tr("Out of date, the scene was edited: checking the path again…")
                               : tr("Checking whether the path is valid in this scene…"));
    check();
  }
}

bool PathValidity::was_valid() const { return player_.made_from() != planning::Revision{}; }

void PathValidity::check() {
  job_.run([this, prepared = scene_, was_valid = was_valid(),
            timeline = player_.timeline()](const std::stop_token& stop) -> LatestJob::Answer {
    const PreparedProblem::Problem problem = prepared->wait(stop);
    if (!problem) {
      return {};
    }
    planning::PathConflictSearch search(*problem);
    const auto conflict =
        search.run(timeline.path().waypoints, [&stop] { return stop.stop_requested(); });
    return [this, reason = conflict ? text_of(*conflict, timeline, was_valid) : QString(),
            revision = prepared->revision()] {
      if (reason.isEmpty()) {
        player_.confirm(revision);
      }
      set(reason.isEmpty() ? State::kValid : State::kInvalid, reason);
    };
  });
}

}  // namespace handway::gui
