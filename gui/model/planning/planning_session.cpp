#include "model/planning/planning_session.h"

#include <algorithm>

namespace handway::gui {
namespace {

constexpr const char* kOptimizeChecks = "optimize_checks";

geometric::PlannerRequest without_optimizing(geometric::PlannerRequest choice) {
  std::erase_if(choice.settings,
                [](const auto& setting) { return setting.first == kOptimizeChecks; });
  return choice;
}

// Does the planner's choice find the run's path again, but for what was optimised since?
bool is_planned_with(const PlanRun& run, const geometric::PlannerRequest& choice) {
  const auto wanted = without_optimizing(run.planner);
  const auto chosen = without_optimizing(choice);
  return wanted.name == chosen.name && wanted.settings == chosen.settings;
}

}  // namespace

PlanningSession::PlanningSession(Document& document, PlanSettings& settings, PathPlayer& player,
                                 QObject* parent)
    : QObject(parent), document_(document), settings_(settings), player_(player) {
  connect(&document_, &Document::opened, this, &PlanningSession::forget);
  connect(&document_, &Document::edited, this, &PlanningSession::take_edit);
  connect(&live_, &LiveReplanner::replanned, this, &PlanningSession::take_replanned);
  connect(&live_, &LiveReplanner::lost, this, &PlanningSession::forget);
  connect(&player_, &PathPlayer::moved, this, [this](double fraction) {
    document_.set_configuration(player_.timeline().at(fraction));
  });
  connect(&document_, &Document::configuration_changed, this, [this](const Eigen::VectorXd& q) {
    if (!document_.shows_measured()) {
      player_.locate(q);
    }
  });
  connect(&runner_, &PlanRunner::progressed, this,
          [this](double fraction, const QString& activity) {
            if (is_current() && is_running()) {
              emit progressed(fraction, activity);
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
  connect(&optimizer_, &OptimizeRunner::progressed, this, [this](const OptimizeProgress& progress) {
    emit optimized_further(progress);
    emit path_optimized(progress.path);
  });
  connect(&optimizer_, &OptimizeRunner::finished, this, &PlanningSession::take_optimized);
  connect(&optimizer_, &OptimizeRunner::failed, this, [this](const QString& message) {
    emit path_optimized({});
    take_failure(message);
  });
}

bool PlanningSession::is_current() const { return planned_ == document_.revision(); }

void PlanningSession::forget() {
  forget_optimizing();
  cancel();
  live_.end();
  shown_.reset();
  opened_from_.clear();
  player_.clear();
  emit forgotten();
  forget_roadmap();
  emit path_changed();
}

void PlanningSession::forget_roadmap() {
  roadmap_.reset();
  emit roadmap_changed();
}

void PlanningSession::start() {
  if (is_running() || !settings_.planner() || !document_.robot()) {
    return;
  }
  forget();
  planned_ = document_.revision();
  begun_.number += std::max(1, static_cast<int>(found_.size()));
  found_.clear();
  begun_.begun = QTime::currentTime();
  begun_.state = document_.state();
  begun_.planner = settings_.choice();
  begun_.preset = settings_.preset();
  begun_.request = settings_.request();
  const bool several = settings_.seeds() > 1;
  if (several) {
    start_seeds();
  } else {
    runner_.start(settings_.planner(), document_.problem(), begun_.request, document_.palm());
  }
  emit started();
  if (several) {
    emit seeds_done(0, 0);
  }
}

void PlanningSession::start_seeds() {
  const int count = settings_.seeds();
  seeds_.start({document_.problem(), settings_.copies(std::min(begun_.request.threads, count)),
                begun_.request, count, document_.recorded_hand().postures()});
}

void PlanningSession::optimize() {
  if (is_running() || !settings_.planner() || player_.timeline().empty() ||
      player_.made_from() != document_.revision()) {
    return;
  }
  planned_ = document_.revision();
  OptimizeTask task;
  task.problem = document_.problem();
  task.objective = settings_.planner()->objective();
  task.request = shown_ ? shown_->request : settings_.request();
  repeatable_ = false;
  if (shown_) {
    task.found = shown_->result;
    repeatable_ = is_planned_with(*shown_, settings_.choice());
  }
  task.found.path = player_.timeline().path();
  task.request.optimize_s = settings_.optimize_limit();
  begun_.number += std::max(1, static_cast<int>(found_.size()));
  found_.clear();
  begun_.begun = QTime::currentTime();
  begun_.state = document_.state();
  begun_.planner = without_optimizing(settings_.choice());
  begun_.preset = tr("%1, optimised").arg(settings_.preset());
  begun_.request = task.request;
  begun_.request.optimize_s = 0.0;  // paths that follow edits are not optimised for so long
  optimizer_.start(std::move(task));
  emit optimizing_started();
}

void PlanningSession::take_optimized(const OptimizeOutcome& outcome) {
  emit path_optimized({});
  planning::PlanResult result = outcome.result;
  if (result.path.waypoints == player_.timeline().path().waypoints) {
    emit result_found(result, {});
    emit ended(true, QString::fromStdString(result.reason));
    return;
  }
  if (repeatable_ && outcome.repeatable) {
    begun_.planner.settings.emplace_back(kOptimizeChecks, std::to_string(result.optimize_checks));
  }
  const PathRecord record = record_of(begun_.request, result, begun_.number);
  emit result_found(result, {});
  shown_ = record.run;
  opened_from_.clear();
  replace_path(result.path, document_.revision());
  live_.begin(document_.problem(), result.path, begun_.request);
  emit run_ended(record);
  emit ended(true, QString::fromStdString(result.reason));
}

// An edit, or another path: what was optimised is of no use any more.
void PlanningSession::forget_optimizing() {
  if (!is_optimizing()) {
    return;
  }
  optimizer_.discard();
  emit path_optimized({});
  emit ended(false, tr("Optimising was cancelled: the scene was edited"));
}

void PlanningSession::cancel() {
  runner_.cancel();
  seeds_.cancel();
  optimizer_.stop();
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
  emit result_found(result, note);
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

void PlanningSession::show_opened(const planning::Path& path, const QString& origin,
                                  const QString& note) {
  forget();
  opened_from_ = origin;
  player_.set_timeline(PathTimeline(*document_.robot()->model, path));
  emit path_changed();
  player_.seek(0.0);
  emit path_opened(note);
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
  emit seeds_done(static_cast<int>(found_.size()), static_cast<int>(solved));
  emit run_ended(record);
}

void PlanningSession::take_seeds(bool cancelled) {
  if (!is_current()) {
    emit ended(false, tr("Planning was cancelled: another scene was opened"));
    return;
  }
  const PathMerit merit = settings_.merit();
  const auto best = best_of(found_, merit);
  const auto done = static_cast<int>(found_.size());
  const QString how_many =
      cancelled ? tr("%1 of %2 seeds, then cancelled").arg(done).arg(settings_.seeds())
                : tr("%1 seeds").arg(done);
  if (best == found_.end()) {
    show_none(tr("No path from %1.").arg(how_many));
    return;
  }
  const auto solved = std::ranges::count_if(found_, &PathRecord::is_solved);
  const QString note = tr("Best path (%1): seed %2. %3 paths from %4.")
                           .arg(superlative(merit))
                           .arg(best->run->request.seed)
                           .arg(solved)
                           .arg(how_many);
  show(*best, note);
  emit ended(true, note);
}

// Shows the bodies that obstructed all of the seeds together.
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
  emit result_found(result, note);
  emit ended(false, note);
}

void PlanningSession::take_edit(const planning::SceneState& before) {
  if (before.scene == document_.scene()) {
    return;
  }
  forget_optimizing();
  if (live_.is_active()) {
    forget_roadmap();
    live_.follow(document_.scene(), document_.problem());
  } else if (!opened_from_.isEmpty()) {
    keep_opened(before);
  } else {
    forget();
  }
}

// Its times, and whether it is valid, are found again.
void PlanningSession::keep_opened(const planning::SceneState& before) {
  const geometric::RobotInstance* robot = document_.robot();
  if (!robot || before.scene->robots.front().model != robot->model) {
    forget();
    return;
  }
  replace_path(planning::Path(player_.timeline().path()), {});
}

void PlanningSession::try_scene(const planning::SceneState& state) { live_.try_scene(state.scene); }

void PlanningSession::take_replanned(const DerivedResult& derived, const QString& origin) {
  const planning::PlanResult& result = derived.value;
  emit replanned(result, origin);
  if (!result.solved()) {
    return;
  }
  shown_.reset();
  replace_path(result.path, derived.made_from);
}

void PlanningSession::replace_path(const planning::Path& path,
                                   const planning::Revision& made_from) {
  const double fraction = player_.fraction();
  const bool was_playing = player_.is_playing();
  const bool was_at_robot = player_.is_at_robot();
  player_.set_timeline(PathTimeline(*document_.robot()->model, path), made_from);
  emit path_changed();
  if (was_at_robot) {
    player_.seek(fraction);
  } else {
    player_.locate(document_.configuration());  // it stays where a person has put it
  }
  if (was_playing) {
    player_.play();
  }
}

void PlanningSession::take_failure(const QString& message) {
  emit failed(message);
  emit ended(false, message);
}

}  // namespace handway::gui
