#include "app/planning_session.h"

#include "panels/result_text.h"

namespace handway::gui {

PlanningSession::PlanningSession(Document& document, PlanPanel& panel, PathPlayer& player,
                                 QObject* parent)
    : QObject(parent), document_(document), panel_(panel), player_(player) {
  connect(&panel_, &PlanPanel::plan_requested, this, &PlanningSession::start);
  connect(&panel_, &PlanPanel::cancel_requested, this, &PlanningSession::cancel);
  connect(&document_, &Document::opened, this, &PlanningSession::forget);
  connect(&document_, &Document::edited, this, &PlanningSession::take_edit);
  connect(&live_, &LiveReplanner::replanned, this, &PlanningSession::take_replanned);
  connect(&live_, &LiveReplanner::lost, this, &PlanningSession::forget);
  connect(&player_, &PathPlayer::moved, this, [this](double fraction) {
    document_.set_configuration(player_.timeline().at(fraction));
  });
  connect(&runner_, &PlanRunner::progressed, this,
          [this](double fraction, const QString& activity) {
            if (is_current() && is_running()) {
              panel_.show_progress(fraction, activity);
            }
          });
  connect(&runner_, &PlanRunner::roadmap_found, this, [this](const SharedRoadmap& roadmap) {
    if (is_current()) {
      roadmap_ = roadmap;
      emit roadmap_changed();
    }
  });
  connect(&runner_, &PlanRunner::finished, this, &PlanningSession::take_result);
  connect(&runner_, &PlanRunner::failed, this, &PlanningSession::take_failure);
}

bool PlanningSession::is_current() const { return planned_ == document_.scene(); }

void PlanningSession::forget() {
  runner_.cancel();
  live_.end();
  player_.clear();
  roadmap_.reset();
  panel_.clear_result();
  emit roadmap_changed();
  emit path_changed();
}

void PlanningSession::start() {
  if (is_running() || !panel_.planner() || !document_.robot()) {
    return;
  }
  forget();
  planned_ = document_.scene();
  panel_.show_running();
  runner_.start(panel_.planner(), document_.problem(), panel_.request(), document_.palm());
  emit started();
}

void PlanningSession::cancel() { runner_.cancel(); }

void PlanningSession::take_result(const planning::PlanResult& result) {
  if (!is_current()) {
    emit ended(false, tr("Planning was cancelled: another scene was opened"));
    return;
  }
  panel_.show_result(result);
  if (result.solved()) {
    player_.set_timeline(PathTimeline(*document_.robot()->model, result.path));
    emit path_changed();
    player_.seek(0.0);
    live_.begin(document_.problem(), result.path, panel_.request());
  }
  emit ended(result.solved(), result_line(result));
}

void PlanningSession::take_edit(const SceneState& before) {
  if (before.scene == document_.scene()) {
    return;
  }
  if (live_.is_active()) {
    live_.follow(document_.scene());
  } else {
    forget();
  }
}

void PlanningSession::try_scene(const SceneState& state) { live_.follow(state.scene); }

void PlanningSession::take_replanned(const planning::PlanResult& result, const QString& way) {
  panel_.show_replanned(result, way);
  if (!result.solved()) {
    return;
  }
  const double fraction = player_.fraction();
  const bool was_playing = player_.is_playing();
  player_.set_timeline(PathTimeline(*document_.robot()->model, result.path));
  emit path_changed();
  player_.seek(fraction);
  if (was_playing) {
    player_.play();
  }
}

void PlanningSession::take_failure(const QString& message) {
  panel_.show_failure(message);
  emit ended(false, message);
}

}  // namespace handway::gui
