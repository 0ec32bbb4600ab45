#pragma once

#include "features/tasks/task_card.h"
#include "features/tasks/task_film.h"
#include "handway/geometric/scene/program.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/tasks/task.h"
#include "model/jobs/background.h"
#include "model/planning/motion_source.h"
#include "view3d/film.h"

#include <QObject>
#include <QPoint>

#include <cstddef>
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
/// Objects stay where they are. When the scene is edited, the task is planned again, first with the
/// grasps of the plan before.
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
  /// Adds a program to the scene, and shows it to be edited.
  void begin_new_program();
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
  /// The film that is shown is to be saved.
  void pictures_wanted(const handway::gui::Film& film);
  /// The plan is to run on the robot.
  void run_wanted(const handway::gui::DerivedSource& source);
  /// A program can't be shown. @param message the reason.
  void failed(const QString& title, const QString& message);
  /// Emitted when there is no plan any more.
  void plan_forgotten();

 private:
  /// Returns the names that the steps of a program can have.
  [[nodiscard]] StepNames step_names() const;
  /// Adds the links of the robot, and the pose of one of them.
  void add_links(StepNames& names) const;
  /// Changes the steps of the shown program in the scene. @param what for the list of edits.
  void change_steps(const std::vector<geometric::ProgramStep>& steps, const QString& what);
  /// Shows a row of the card: a stage of the plan, or why a stage failed.
  void show_row(int row);
  /// Shows the first moment of a stage, at a pause.
  void show_stage(std::size_t stage);
  /// Shows the reason and the posture of the first candidate that failed; a second time: no longer.
  void show_trial(std::size_t trial);
  void hide_trial();
  /// Returns the objects that the selected or picked object can be placed on.
  [[nodiscard]] QStringList supports_of(const geometric::SceneObject& object) const;
  /// Plans again in an edited scene if there was a plan; ends if the task is not possible there.
  void follow_edit();
  /// State of the shown steps after an edit.
  enum class Steps {
    kGone,     ///< An object is not there any more, or the program.
    kChanged,  ///< They are other ones.
    kTheSame
  };
  /// Shows the steps and choices of the edited scene.
  [[nodiscard]] Steps update_steps();
  [[nodiscard]] Steps update_program();
  /// Takes a program of the scene, and the objects that it picks.
  /// @throws InputError if it is not possible in the scene.
  void take_program(const geometric::Program& program);
  /// Returns the scene's program of that name, or null.
  [[nodiscard]] const geometric::Program* find_program(const std::string& name) const;
  /// Returns the steps that the card shows.
  [[nodiscard]] geometric::Program shown_program() const;
  /// Keeps the steps as a program of the scene, or removes the program that is shown.
  void keep_or_remove();
  void apply(const QString& text, geometric::Scene scene);
  void start();
  /// Plans the shown steps. @param again the scene was edited meanwhile.
  void plan_steps(bool again);
  /// Shows a plan, and plays it. @param again it is not played: the user edits the scene.
  void take(const planning::Derived<FilmedTask>& task, bool again);
  /// Simulates the plan, or shows its simulation again.
  void simulate();
  /// Ends the search or the simulation.
  void stop();
  void play(const std::vector<TaskFrame>& frames);
  /// Returns the plan as something to export or to run.
  [[nodiscard]] DerivedSource source() const;
  void ask_for_export();
  /// Returns the frames that are shown as a film.
  [[nodiscard]] Film film() const;
  void show_frame(int index);
  /// Shows the scene as it is, instead of a moment of the task.
  void show_scene();
  void forget_plan();
  /// Forgets the plan, and asks again.
  void ask_again();
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
  bool is_keeping_ = false;                 ///< The scene is edited to keep the steps.
  bool follows_ = false;                    ///< Edits are planned again: a plan was wanted.
  planning::GraspsByObject grasps_;         ///< Grasps of the last plan.
  std::vector<TaskFrame> frames_;           ///< The frames that the film bar plays.
  std::optional<std::size_t> shown_trial_;  ///< The stage whose failure is shown.
  LatestJob job_;
  LatestJob simulation_job_;
};

/// Adds the commands that pick and place the selected object, and that show the scene's programs.
void add_tasks(Workbench& workbench);

}  // namespace handway::gui
