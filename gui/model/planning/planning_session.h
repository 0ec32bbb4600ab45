#pragma once

#include "model/document/document.h"
#include "model/planning/live_replanner.h"
#include "model/planning/optimize_runner.h"
#include "model/planning/path_history.h"
#include "model/planning/plan_runner.h"
#include "model/planning/plan_settings.h"
#include "model/planning/seed_runner.h"
#include "model/playback/path_player.h"

#include <QObject>

#include <memory>
#include <vector>

namespace handway::gui {

/// Plans for the document: runs the chosen planner on its scene, with one seed or
/// several, moves its robot along the result, and keeps the path valid while the scene is
/// edited.
class PlanningSession : public QObject {
  Q_OBJECT

 public:
  /// All outlive the session.
  PlanningSession(Document& document, PlanSettings& settings, PathPlayer& player,
                  QObject* parent = nullptr);

  void start();
  /// Continues optimising the path that is shown, for the planner's objective; the result is a path
  /// of its own, as after planning. Nothing happens without a path that is valid in the present
  /// scene.
  void optimize();
  /// Stops the running plan; of optimising, the best path so far is the result.
  void cancel();
  [[nodiscard]] bool is_running() const {
    return runner_.is_running() || seeds_.is_running() || is_optimizing();
  }
  [[nodiscard]] bool is_optimizing() const { return optimizer_.is_running(); }
  /// Discards the path and the running plan.
  void forget();
  /// Shows what a run found in the scene that is open, as if it had just ended.
  /// @pre it has a run; none is going on.
  void show(const PathRecord& record, const QString& note = {});
  /// Shows a path that was not planned here. It stays as it is while the scene is edited; whether
  /// it is valid there is PathValidity's to find out.
  /// @param origin where it comes from, such as a file's name.
  /// @param note what is to be known of it, a sentence.
  /// @pre the waypoints are configurations of the document's robot.
  void show_opened(const planning::Path& path, const QString& origin, const QString& note);
  /// Returns the source of a path that was not planned here; empty if it was, or if there is none.
  [[nodiscard]] const QString& opened_from() const { return opened_from_; }
  /// The run whose path is shown; null if there is none, or the path has followed edits.
  [[nodiscard]] const std::shared_ptr<const PlanRun>& shown_run() const { return shown_; }
  /// Returns whether a path is being planned after an edit.
  [[nodiscard]] bool is_replanning() const { return live_.is_busy(); }

  /// Returns the roadmap of the last run as far as it has grown; null: none.
  [[nodiscard]] const SharedRoadmap& roadmap() const { return roadmap_; }

  /// Plans for a scene that is only tried, such as while an object is dragged.
  void try_scene(const planning::SceneState& state);

 signals:
  void started();
  void optimizing_started();
  /// The path that is being optimised, as it is by now; empty: none is any more.
  void path_optimized(const handway::planning::Path& path);
  void progressed(double fraction, const QString& activity);
  /// Emitted when `done` of several seeds are done, of which `solved` found a path.
  void seeds_done(int done, int solved);
  void optimized_further(const handway::gui::OptimizeProgress& progress);
  /// Emitted with the result of a run, or of several seeds together. @param note to be shown first;
  /// may be empty.
  void result_found(const handway::planning::PlanResult& result, const QString& note);
  /// A path follows an edit, or there is none. @param origin how it was found, a few words.
  void replanned(const handway::planning::PlanResult& result, const QString& origin);
  void failed(const QString& message);
  /// A path is shown that was not planned here.
  void path_opened(const QString& note);
  /// Emitted when earlier results are not valid any more.
  void forgotten();
  /// roadmap() is another one, or has grown.
  void roadmap_changed();
  /// The player has a new timeline, or none.
  void path_changed();
  /// One of several seeds, or the only one. Its path may not be timed yet.
  void run_ended(const handway::gui::PathRecord& record);
  /// @param message one line for the log.
  void ended(bool solved, const QString& message);

 private:
  void start_seeds();
  [[nodiscard]] PathRecord record_of(const planning::PlanRequest& request,
                                     const planning::PlanResult& result, int number) const;
  void take_result(const planning::PlanResult& result);
  void take_seed(const SeedOutcome& outcome);
  void take_seeds(bool cancelled);
  void show_none(const QString& note);
  void take_optimized(const OptimizeOutcome& outcome);
  void forget_optimizing();
  /// The player plays a path from where it is in the one before.
  void replace_path(const planning::Path& path, const planning::Revision& made_from);
  void take_edit(const planning::SceneState& before);
  void keep_opened(const planning::SceneState& before);
  void take_replanned(const DerivedResult& derived, const QString& origin);
  void forget_roadmap();
  void take_failure(const QString& message);
  [[nodiscard]] bool is_current() const;

  Document& document_;
  PlanSettings& settings_;
  PathPlayer& player_;
  PlanRunner runner_;
  SeedRunner seeds_;
  LiveReplanner live_;
  planning::Revision planned_;     ///< Revision of the present run.
  PlanRun begun_;                  ///< Present run, as known at its start.
  std::vector<PathRecord> found_;  ///< Paths of its seeds.
  std::shared_ptr<const PlanRun> shown_;
  OptimizeRunner optimizer_;
  bool repeatable_ = false;  ///< True if the settings repeat the optimised path.
  SharedRoadmap roadmap_;
  QString opened_from_;
};

}  // namespace handway::gui
