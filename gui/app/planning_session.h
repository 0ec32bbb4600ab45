#pragma once

#include "app/document.h"
#include "panels/plan_panel.h"
#include "workers/live_replanner.h"
#include "workers/path_player.h"
#include "workers/plan_runner.h"

#include <QObject>

#include <memory>

namespace handway::gui {

/// From a click on Plan to a path that plays: runs the panel's planner on the
/// document's scene, moves the document's robot along the result, and keeps the
/// path valid while the scene is edited.
class PlanningSession : public QObject {
  Q_OBJECT

 public:
  /// All outlive the session.
  PlanningSession(Document& document, PlanPanel& panel, PathPlayer& player,
                  QObject* parent = nullptr);

  void start();
  void cancel();
  [[nodiscard]] bool is_running() const { return runner_.is_running(); }
  /// True while a path follows an edit.
  [[nodiscard]] bool is_replanning() const { return live_.is_busy(); }

  /// Of the last run, as far as it is; null: none.
  [[nodiscard]] const SharedRoadmap& roadmap() const { return roadmap_; }

  /// Plans for a scene that is only tried, such as while an object is dragged.
  void try_scene(const SceneState& state);

 signals:
  void started();
  /// roadmap() is another one, or has grown.
  void roadmap_changed();
  /// The player has a new timeline, or none.
  void path_changed();
  /// @param message one line for the log.
  void ended(bool solved, const QString& message);

 private:
  void forget();
  void take_result(const planning::PlanResult& result);
  void take_edit(const SceneState& before);
  void take_replanned(const planning::PlanResult& result, const QString& way);
  void take_failure(const QString& message);
  [[nodiscard]] bool is_current() const;

  Document& document_;
  PlanPanel& panel_;
  PathPlayer& player_;
  PlanRunner runner_;
  LiveReplanner live_;
  std::shared_ptr<const geometric::Scene> planned_;  ///< Scene of the run that goes on.
  SharedRoadmap roadmap_;
};

}  // namespace handway::gui
