#pragma once

#include "model/planning/path_history.h"

#include <QObject>

namespace handway::gui {

class PlanPanel;
class PlanningSession;
class RunsPanel;
class SceneEditor;

/// Keeps the runs of a session in the history, and puts them back.
class RunsTool : public QObject {
  Q_OBJECT

 public:
  /// All outlive it.
  RunsTool(PathHistory& history, RunsPanel& runs, PlanningSession& session, PlanPanel& panel,
           SceneEditor& editor, QObject* parent = nullptr);

  /// Gives panel and scene what the run began with, and shows what it found; what changes the
  /// scene can be undone. Nothing happens while a planner runs.
  /// @pre the record has a run, of the scene that is open.
  void restore(const PathRecord& record);

 private:
  PlanningSession& session_;
  PlanPanel& panel_;
  SceneEditor& editor_;
};

}  // namespace handway::gui
