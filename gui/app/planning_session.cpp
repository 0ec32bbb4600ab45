#include "app/planning_session.h"

#include "panels/result_text.h"
#include "presets/preset_bar.h"

#include <algorithm>

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
  connect(&seeds_, &SeedRunner::found, this, &PlanningSession::take_seed);
  connect(&seeds_, &SeedRunner::ended, this, &PlanningSession::take_seeds);
  connect(&seeds_, &SeedRunner::failed, this, &PlanningSession::take_failure);
}

bool PlanningSession::is_current() const { return planned_ == document_.revision(); }

void PlanningSession::forget() {
  cancel();
  live_.end();
  shown_.reset();
  player_.clear();
  panel_.clear_result();
  forget_roadmap();
  emit path_changed();
}

void PlanningSession::forget_roadmap() {
  roadmap_.reset();
  emit roadmap_changed();
}

void PlanningSession::start() {
  if (is_running() || !panel_.planner() || !document_.robot()) {
    return;
  }
  forget();
  planned_ = document_.revision();
  begun_.number += std::max(1, static_cast<int>(found_.size()));
  found_.clear();
  begun_.begun = QTime::currentTime();
  begun_.state = document_.state();
  begun_.planner = panel_.choice();
  begun_.preset = panel_.presets().words();
  begun_.request = panel_.request();
  panel_.show_running();
  if (panel_.seeds() > 1) {
    start_seeds();
  } else {
    runner_.start(panel_.planner(), document_.problem(), begun_.request, document_.palm());
  }
  emit started();
}

void PlanningSession::start_seeds() {
  const int count = panel_.seeds();
  panel_.show_seeds(0, 0);
  seeds_.start({document_.problem(), panel_.copies(std::min(begun_.request.threads, count)),
                begun_.request, count, document_.recorded_hand().postures()});
}

void PlanningSession::cancel() {
  runner_.cancel();
  seeds_.cancel();
}

PathRecord PlanningSession::record_of(const planning::PlanRequest& request,
                                      const planning::PlanResult& result, int number) const {
  auto run = std::make_shared<PlanRun>(begun_);
  run->number = number;
  run->request = request;
  run->result = result;
  PathRecord record;
  record.scene = begun_.state.scene;
  record.palm = document_.palm();
  record.run = std::move(run);
  return record;
}

void PlanningSession::show(const PathRecord& record, const QString& note) {
  const planning::PlanResult& result = record.run->result;
  panel_.show_result(result, note);
  if (!result.solved()) {
    return;
  }
  shown_ = record.run;
  const bool is_of_this_scene = record.run->state.scene == document_.scene();
  player_.set_timeline(PathTimeline(*document_.robot()->model, result.path),
                       is_of_this_scene ? document_.revision() : planning::Revision{});
  emit path_changed();
  player_.seek(0.0);
  live_.begin(document_.problem(), result.path, record.run->request);
}

void PlanningSession::take_result(const planning::PlanResult& result) {
  if (!is_current()) {
    emit ended(false, tr("Planning was cancelled: another scene was opened"));
    return;
  }
  const PathRecord record = record_of(begun_.request, result, begun_.number);
  show(record);
  emit run_ended(record);
  emit ended(result.solved(), result_line(result));
}

void PlanningSession::take_seed(const SeedOutcome& outcome) {
  if (!is_current()) {
    return;
  }
  PathRecord record =
      record_of(outcome.request, outcome.result, begun_.number + static_cast<int>(found_.size()));
  record.motion = outcome.motion;
  record.curves = outcome.curves;
  if (record.motion) {
    record.figures = figures_of(record);
  }
  found_.push_back(record);
  const auto solved = std::ranges::count_if(found_, &PathRecord::is_solved);
  panel_.show_seeds(static_cast<int>(found_.size()), static_cast<int>(solved));
  emit run_ended(record);
}

void PlanningSession::take_seeds(bool cancelled) {
  if (!is_current()) {
    emit ended(false, tr("Planning was cancelled: another scene was opened"));
    return;
  }
  const PathMerit merit = panel_.merit();
  const auto best = best_of(found_, merit);
  const auto done = static_cast<int>(found_.size());
  const QString how_many = cancelled
                               ? tr("%1 of %2 seeds, then cancelled").arg(done).arg(panel_.seeds())
                               : tr("%1 seeds").arg(done);
  if (best == found_.end()) {
    show_none(tr("No path from %1.").arg(how_many));
    return;
  }
  const auto solved = std::ranges::count_if(found_, &PathRecord::is_solved);
  const QString note = tr("The %1 path is that of seed %2 (%3 paths from %4).")
                           .arg(superlative(merit))
                           .arg(best->run->request.seed)
                           .arg(solved)
                           .arg(how_many);
  show(*best, note);
  emit ended(true, note);
}

// What stood in the way of all of them together.
void PlanningSession::show_none(const QString& note) {
  planning::PlanResult result;
  result.status = planning::PlanStatus::kCancelled;
  if (!found_.empty()) {
    const auto& last = found_.back().run->result;
    result.status = last.status;
    result.reason = last.reason;
  }
  for (const PathRecord& record : found_) {
    result.statistics += record.run->result.statistics;
    result.time_s += record.run->result.time_s;
  }
  panel_.show_result(result, note);
  emit ended(false, note);
}

void PlanningSession::take_edit(const SceneState& before) {
  if (before.scene == document_.scene()) {
    return;
  }
  if (live_.is_active()) {
    forget_roadmap();
    live_.follow(document_.scene(), document_.revision());
  } else {
    forget();
  }
}

void PlanningSession::try_scene(const SceneState& state) { live_.follow(state.scene, {}); }

void PlanningSession::take_replanned(const DerivedResult& replanned, const QString& way) {
  const planning::PlanResult& result = replanned.value;
  panel_.show_replanned(result, way);
  if (!result.solved()) {
    return;
  }
  shown_.reset();
  const double fraction = player_.fraction();
  const bool was_playing = player_.is_playing();
  player_.set_timeline(PathTimeline(*document_.robot()->model, result.path), replanned.made_from);
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
