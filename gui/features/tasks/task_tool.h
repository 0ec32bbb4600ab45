#pragma once

#include "features/tasks/task_card.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/tasks/task.h"
#include "model/jobs/background.h"
#include "model/planning/motion_source.h"

#include <QObject>
#include <QPoint>
#include <QTimer>

#include <cstddef>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::gui {

class Document;
class PlanSettings;
class SceneEditor;
class SceneView;
class Workbench;

/// A moment of a task.
struct TaskFrame {
  std::size_t stage = 0;  ///< Index into TaskPlan::stages.
  planning::Configuration q;
  geometric::Pose X_WO = geometric::Pose::Identity();  ///< Pose of the object.
};

/// A planned task, with all that is shown of it.
struct FilmedTask {
  planning::Task task;
  planning::TaskPlan plan;
  std::vector<ShownStage> stages;
  std::vector<TaskFrame> frames;  ///< One every 20 ms.
};

/// Plans to pick the selected object and to place it somewhere else, and plays the plan. The scene
/// stays as it is.
class TaskTool : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. The card floats over the view.
  TaskTool(Document& document, SceneEditor& editor, SceneView& view,
           const planning::PluginManager& plugins, QObject* parent = nullptr);

  /// Asks where to place the selected object.
  void begin();
  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }
  /// Returns the last plan; without stages if there is none.
  [[nodiscard]] const planning::TaskPlan& plan() const { return task_.value.plan; }

 signals:
  /// Emitted when there is room in the view for the handles of the selection, or not because they
  /// would hide the object.
  void handles_welcome(bool welcome);
  /// The plan is to be exported.
  void export_wanted(const handway::gui::DerivedSource& source);

 private:
  void start();
  void take(const planning::Derived<FilmedTask>& task);
  void play(bool wanted);
  void ask_for_export();
  void show_next_frame();
  /// Shows the scene as it is, instead of a moment of the task.
  void end_film();
  void end();
  /// Returns the points of the view that should stay visible: the object's ways.
  [[nodiscard]] std::vector<QPoint> to_be_seen() const;

  Document& document_;
  SceneEditor& editor_;
  SceneView& view_;
  const planning::PluginManager& plugins_;
  TaskCard* card_;
  std::string object_;
  planning::Derived<FilmedTask> task_;
  QTimer film_;
  std::size_t next_frame_ = 0;
  LatestJob job_;
};

/// Adds the command that picks and places the selected object.
void add_tasks(Workbench& workbench);

}  // namespace handway::gui
