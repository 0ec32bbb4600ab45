#pragma once

#include "handway/planning/core/planning_problem.h"

#include <QObject>
#include <QString>

class QAction;

namespace handway::gui {

class PlanPanel;
class Workbench;

/// The window's commands to plan, to optimise and to cancel, with what they find: the path in the
/// view, and lines in the log.
class PlanningCommands : public QObject {
  Q_OBJECT

 public:
  /// The workbench and the panel outlive it.
  PlanningCommands(Workbench& workbench, PlanPanel& panel);

  /// Switches of what is drawn of a search.
  [[nodiscard]] QAction& roadmap_shown() const { return *roadmap_shown_; }
  [[nodiscard]] QAction& hypercubes_shown() const { return *hypercubes_shown_; }

 private:
  void place_actions();
  void connect_session();
  void update_ready();
  void show_running();
  void show_start();
  void show_end(bool solved, const QString& text);
  void show_path();
  void show_optimized(const planning::Path& path);
  void show_validity();
  /// Writes into the log what is wrong with the person's presets, if anything is.
  void report_presets();

  Workbench& workbench_;
  PlanPanel& panel_;
  QString why_not_;  ///< There is nothing to plan; empty if there is.
  QAction* plan_;
  QAction* cancel_;
  QAction* optimize_;
  QAction* roadmap_shown_;
  QAction* hypercubes_shown_;
};

/// Adds the panel that plans, and what there is to see of planning: collisions, the query, the
/// region that is sampled, the roadmap in the view and its projection.
void add_planning(Workbench& workbench);

}  // namespace handway::gui
