#pragma once

#include "features/tasks/task_card.h"
#include "features/tasks/task_film.h"
#include "handway/geometric/scene/program.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/tasks/task.h"
#include "model/jobs/background.h"
#include "model/planning/motion_source.h"

#include <QObject>
#include <QPoint>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::gui {

class Document;
class PlanSettings;
class SceneEditor;
class SceneView;
class Workbench;

/// Plans to pick the selected object and to place it somewhere else, or a program of the scene. It
/// plays the plan, simulates whether the hand holds the objects, and keeps the steps in the scene.
/// Objects stay where they are.
class TaskTool : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. The card floats over the view.
  TaskTool(Document& document, SceneEditor& editor, SceneView& view,
           const planning::PluginManager& plugins, QObject* parent = nullptr);

  /// Asks where to place the selected object.
  void begin();
  /// Shows a program of the scene. @param name of one.
  void begin_program(const std::string& name);
  [[nodiscard]] bool is_busy() const { return job_.is_busy() || simulation_job_.is_busy(); }
  /// Returns the last plan; without stages if there is none.
  [[nodiscard]] const planning::TaskPlan& plan() const { return task_.value.plan; }
  /// Returns the simulation of that plan, if it was simulated.
  [[nodiscard]] const std::optional<SimulatedTask>& simulation() const { return simulation_; }

 signals:
  /// Emitted when there is room in the view for the handles of the selection, or not because they
  /// would hide the object.
  void handles_welcome(bool welcome);
  /// The plan is to be exported.
  void export_wanted(const handway::gui::DerivedSource& source);
  /// The plan is to run on the robot.
  void run_wanted(const handway::gui::DerivedSource& source);
  /// A program can't be shown. @param message the reason.
  void failed(const QString& title, const QString& message);
  /// Emitted when there is no plan any more.
  void plan_forgotten();

 private:
  void ask(const QString& title, std::vector<std::string> objects, const QStringList& supports);
  /// Returns the steps that the card shows.
  [[nodiscard]] geometric::Program shown_program() const;
  /// Keeps the steps as a program of the scene, or removes the program that is shown.
  void keep_or_remove();
  void apply(const QString& text, geometric::Scene scene);
  void start();
  void take(const planning::Derived<FilmedTask>& task);
  /// Simulates the plan, or shows its simulation again.
  void simulate();
  /// Ends the search or the simulation.
  void stop();
  void play(const std::vector<TaskFrame>& frames);
  /// Returns the plan as something to export or to run.
  [[nodiscard]] DerivedSource source() const;
  void ask_for_export();
  void show_frame(int index);
  /// Shows the scene as it is, instead of a moment of the task.
  void show_scene();
  /// Forgets the plan, and asks again.
  void forget_plan();
  void end();
  /// Returns the points of the view that should stay visible: the object's ways.
  [[nodiscard]] std::vector<QPoint> to_be_seen() const;

  Document& document_;
  SceneEditor& editor_;
  SceneView& view_;
  const planning::PluginManager& plugins_;
  TaskCard* card_;
  std::optional<geometric::Program> program_;  ///< Program of the scene; empty: pick and place.
  std::vector<std::string> objects_;           ///< Picked objects, each once.
  planning::Derived<FilmedTask> task_;
  std::optional<SimulatedTask> simulation_;
  bool is_keeping_ = false;        ///< The scene is edited to keep the steps.
  std::vector<TaskFrame> frames_;  ///< The frames that the film bar plays.
  LatestJob job_;
  LatestJob simulation_job_;
};

/// Adds the commands that pick and place the selected object, and that show the scene's programs.
void add_tasks(Workbench& workbench);

}  // namespace handway::gui
