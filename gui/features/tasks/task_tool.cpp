#include "features/tasks/task_tool.h"

#include "features/workbench.h"
#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/setup/placing.h"
#include "handway/planning/tasks/task_file.h"
#include "handway/planning/tasks/timed_task.h"
#include "handway/planning/timing/time_path.h"
#include "model/document/document.h"
#include "model/document/scene_editor.h"
#include "view3d/scene_view.h"
#include "view3d/view_gizmo.h"
#include "widgets/style/actions.h"

#include <QAction>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kFrameTime = 20;  // ms

// The objects that another one can be placed on, the one below it first.
std::vector<std::string> supports_of(const geometric::Scene& scene,
                                     const geometric::SceneObject& object) {
  std::vector<std::pair<double, std::string>> found;
  for (const geometric::SceneObject& other : scene.objects) {
    if (other.name == object.name || other.attachment) {
      continue;
    }
    geometric::Scene alone;
    alone.objects = {other};
    const auto gap = geometric::gap_to_support(alone, object);
    found.emplace_back(gap ? std::abs(*gap) : std::numeric_limits<double>::infinity(), other.name);
  }
  std::ranges::stable_sort(found, {}, &std::pair<double, std::string>::first);
  std::vector<std::string> names;
  std::ranges::transform(found, std::back_inserter(names), &std::pair<double, std::string>::second);
  return names;
}

// Adds what is shown of a timed task, or the fault of the first stage that is not cleared.
void add_film(const planning::TimedTask& timed, const std::string& object, FilmedTask& task) {
  for (std::size_t i = 0; i < timed.stages.size(); ++i) {
    const planning::TimedPath& stage = timed.stages[i];
    const planning::TaskStage& planned = task.plan.stages[i];
    if (!stage.cleared()) {
      task.plan.solved = false;
      task.plan.reason = to_text(stage.preflight);
      return;
    }
    task.stages.push_back({planned.kind, stage.preflight.duration, stage.preflight.min_clearance,
                           QString::fromStdString(stage.preflight.closest_pair)});
    const geometric::SceneObject& moved = *planned.state.find(object);
    for (const planning::TrajectoryPoint& point : stage.motion.trajectory.points) {
      task.frames.push_back(
          {i, point.position, object_pose(*planned.state.scene, point.position, moved)});
    }
  }
}

}  // namespace

TaskTool::TaskTool(Document& document, SceneEditor& editor, SceneView& view,
                   const planning::PluginManager& plugins, QObject* parent)
    : QObject(parent),
      document_(document),
      editor_(editor),
      view_(view),
      plugins_(plugins),
      card_(new TaskCard(&view, [this] { return to_be_seen(); })) {
  film_.setInterval(kFrameTime);
  connect(&film_, &QTimer::timeout, this, &TaskTool::show_next_frame);
  connect(card_, &TaskCard::plan_wanted, this, &TaskTool::start);
  connect(card_, &TaskCard::play_wanted, this, &TaskTool::play);
  connect(card_, &TaskCard::export_wanted, this, &TaskTool::ask_for_export);
  connect(card_, &TaskCard::closed, this, &TaskTool::end);
  connect(card_, &TaskCard::stop_wanted, this, [this] {
    job_.cancel();
    card_->show_failure(tr("The search was stopped."), {});
  });
  connect(&job_, &LatestJob::failed, this,
          [this](const QString& reason) { card_->show_failure(reason, {}); });
  connect(&document_, &Document::opened, this, &TaskTool::end);
  connect(&document_, &Document::edited, this, [this](const planning::SceneState& before) {
    if (before.scene != document_.scene()) {
      end();  // the plan is of another scene
    }
  });
}

void TaskTool::begin() {
  const geometric::SceneObject* object = editor_.selected_object();
  if (object == nullptr || !document_.robot()) {
    return;
  }
  end();
  object_ = object->name;
  QStringList supports;
  for (const std::string& name : supports_of(*document_.scene(), *object)) {
    supports.push_back(QString::fromStdString(name));
  }
  card_->ask(QString::fromStdString(object_), supports, 0);
}

void TaskTool::start() {
  end_film();
  card_->show_planning();
  planning::SceneState state = editor_.state();
  if (!state.scene->start) {  // the task begins where the robot is shown
    geometric::Scene scene = *state.scene;
    scene.start = document_.configuration();
    state.scene = std::make_shared<const geometric::Scene>(std::move(scene));
  }
  planning::Task task{planning::PickStep{object_},
                      planning::PlaceStep{card_->support().toStdString()}};
  if (card_->returns()) {
    task.emplace_back(planning::move_to_posture(*state.scene, "start", "task"));
  }
  job_.run([this, state, task, object = object_,
            revision = document_.revision()](const std::stop_token& stop) -> LatestJob::Answer {
    const auto& planners = plugins_.planners();
    const auto planner = planners.create(planners.names().front());
    planning::TaskOptions options;
    options.threads = 2;
    FilmedTask filmed;
    filmed.task = task;
    try {
      filmed.plan = plan_task(state, task, *planner, options, stop);
      planning::TimingOptions timing;
      timing.period = kFrameTime / 1000.0;
      timing.stop = stop;
      add_film(time_task(task, filmed.plan, "task", timing), object, filmed);
    } catch (const geometric::PreparationStopped&) {
      return nullptr;
    }
    return [this, filmed = planning::Derived<FilmedTask>{std::move(filmed), revision}] {
      take(filmed);
    };
  });
}

void TaskTool::take(const planning::Derived<FilmedTask>& task) {
  if (task.made_from != document_.revision()) {
    card_->show_failure(tr("The scene was edited meanwhile. Plan again."), {});
    return;
  }
  task_ = task;
  const planning::TaskPlan& plan = task_.value.plan;
  if (plan.solved) {
    card_->show_plan(task_.value.stages, plan.time_s);
    play(true);
  } else {
    card_->show_failure(QString::fromStdString(plan.reason), plan.trials);
  }
}

void TaskTool::play(bool wanted) {
  end_film();
  if (wanted && !task_.value.frames.empty()) {
    next_frame_ = 0;
    emit handles_welcome(false);
    view_.preview_ghost(true, std::nullopt);
    view_.preview_ghost(false, std::nullopt);
    film_.start();
    show_next_frame();
  }
}

void TaskTool::ask_for_export() {
  end_film();
  MotionSource source;
  source.title = tr("Export the task");
  source.name = QStringLiteral("place_") + QString::fromStdString(object_);
  source.time = [task = task_.value.task, plan = task_.value.plan](
                    const std::string& name, const planning::TimingOptions& options) {
    return whole_task(time_task(task, plan, name, options));
  };
  emit export_wanted({std::move(source), task_.made_from});
}

void TaskTool::show_next_frame() {
  const std::vector<TaskFrame>& frames = task_.value.frames;
  if (next_frame_ >= frames.size()) {
    end_film();
    return;
  }
  const TaskFrame& frame = frames[next_frame_++];
  view_.set_configuration(frame.q);
  view_.preview(object_item(object_), frame.X_WO);
  card_->show_played(static_cast<int>(frame.stage));
}

void TaskTool::end_film() {
  card_->show_played(-1);
  if (!film_.isActive()) {
    return;
  }
  film_.stop();
  const std::shared_ptr<const geometric::Scene> scene = document_.scene();
  if (const auto* object = scene ? geometric::find_object(*scene, object_) : nullptr) {
    view_.preview(object_item(object_), object->X_PO);
  }
  if (document_.robot()) {
    view_.set_configuration(document_.configuration());
    view_.preview_ghost(true, scene->start);
    view_.preview_ghost(false, scene->goal);
  }
  emit handles_welcome(true);
}

void TaskTool::end() {
  end_film();
  job_.cancel();
  task_ = {};
  card_->hide();
}

std::vector<QPoint> TaskTool::to_be_seen() const {
  std::vector<Eigen::Vector3d> places;
  const std::shared_ptr<const geometric::Scene> scene = document_.scene();
  if (const auto* object = scene ? geometric::find_object(*scene, object_) : nullptr) {
    places.emplace_back(object->X_PO.translation());
  }
  for (const TaskFrame& frame : task_.value.frames) {
    places.emplace_back(frame.X_WO.translation());
  }
  std::vector<QPoint> seen;
  for (const Eigen::Vector3d& place : places) {
    if (view_.camera().place_of(place)) {  // it is before the camera
      seen.push_back(place_of(view_.camera(), view_.size(), place).toPoint());
    }
  }
  return seen;
}

void add_tasks(Workbench& workbench) {
  auto& tool = workbench.own<TaskTool>(workbench.document, workbench.editor, workbench.view,
                                       *workbench.plugins);
  QAction* pick = workbench.make_action(
      QStringLiteral("pick_and_place"), QObject::tr("&Pick and place…"),
      QKeySequence(QStringLiteral("Ctrl+Alt+G")),
      QObject::tr("Plan to grasp the object, carry it and place it, and show the motion"));
  workbench.add_to_menu(MainMenu::kPlan, {0, 20}, pick);
  workbench.add_to_menu(MainMenu::kContext, {3, 1}, pick);
  const auto update_enabled = [pick, &workbench] {
    const geometric::SceneObject* object = workbench.editor.selected_object();
    allow(*pick, !workbench.document.robot() ? QObject::tr("The scene has no robot.")
                 : !object                   ? QObject::tr("Select an object first.")
                 : object->attachment ? QObject::tr("The robot holds it already: detach it first.")
                 : workbench.document.scene()->objects.size() < 2
                     ? QObject::tr("There is nothing else to place it on.")
                     : QString());
  };
  QObject::connect(pick, &QAction::triggered, &tool, &TaskTool::begin);
  QObject::connect(&tool, &TaskTool::export_wanted, &workbench, &Workbench::export_wanted);
  QObject::connect(&tool, &TaskTool::handles_welcome, &workbench, &Workbench::handles_welcome);
  QObject::connect(&workbench.document, &Document::opened, pick, update_enabled);
  QObject::connect(&workbench.document, &Document::edited, pick, update_enabled);
  QObject::connect(&workbench.editor, &SceneEditor::selection_changed, pick, update_enabled);
  workbench.add_work([&tool] { return tool.is_busy(); });
  update_enabled();
}

}  // namespace handway::gui
