#pragma once

#include "model/planning/path_history.h"

#include <QModelIndex>
#include <QObject>
#include <QWidget>

#include <memory>
#include <vector>

class QLabel;
class QPushButton;
class QSortFilterProxyModel;

namespace handway::gui {

class PlanSettings;
class PlanningSession;
class RunTable;
class RunView;
class SceneEditor;
class Workbench;

/// The runs of the scene that is open, the latest first, to be looked at and put back.
class RunsPanel : public QWidget {
  Q_OBJECT

 public:
  /// @param history outlives the panel.
  explicit RunsPanel(PathHistory& history, QWidget* parent = nullptr);

  [[nodiscard]] QSize sizeHint() const override { return {640, 250}; }
  /// Makes a run stand out; null: none.
  void mark(const std::shared_ptr<const PlanRun>& run);
  void set_running(bool running);

 signals:
  void restore_requested(const handway::gui::PathRecord& record);
  void compare_requested();

 private:
  [[nodiscard]] QWidget* make_actions();
  void refresh();
  void show_actions();
  /// Returns the row of the run in the sorted table; none if it is not listed.
  [[nodiscard]] QModelIndex row_of(const std::shared_ptr<const PlanRun>& run) const;
  /// nullptr if none is chosen.
  [[nodiscard]] const PathRecord* chosen() const;
  void restore();

  PathHistory& history_;
  std::vector<PathRecord> records_;  ///< In the order of the table.
  std::shared_ptr<const PlanRun> marked_;
  bool running_ = false;
  RunTable* table_;
  QSortFilterProxyModel* sorted_;
  RunView* view_;
  QLabel* state_;
  QPushButton* restore_;
  QPushButton* compare_;
};

/// Adds the runs of a session to the history, and restores them.
class RunsTool : public QObject {
  Q_OBJECT

 public:
  /// All outlive it.
  RunsTool(PathHistory& history, RunsPanel& runs, PlanningSession& session, PlanSettings& settings,
           SceneEditor& editor, QObject* parent = nullptr);

  /// Restores the settings and the scene of the run, and shows its result; changes of the scene can
  /// be undone. Nothing happens while a planner runs.
  /// @pre the record has a run, of the scene that is open.
  void restore(const PathRecord& record);

 private:
  PlanningSession& session_;
  PlanSettings& settings_;
  SceneEditor& editor_;
};

/// Adds the panel below the view.
void add_runs(Workbench& workbench);

}  // namespace handway::gui
