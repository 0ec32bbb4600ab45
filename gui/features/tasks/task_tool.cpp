#include "features/tasks/task_tool.h"

#include "features/workbench.h"
#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/inverse_kinematics.h"
#include "handway/geometric/setup/placing.h"
#include "handway/planning/tasks/resting_places.h"
#include "handway/planning/tasks/task_file.h"
#include "handway/planning/tasks/timed_task.h"
#include "model/document/document.h"
#include "model/document/scene_editor.h"
#include "view3d/grasp_drawings.h"
#include "view3d/overlay.h"
#include "view3d/scene_view.h"
#include "view3d/view_gizmo.h"
#include "widgets/panels/film_bar.h"
#include "widgets/style/actions.h"

#include <QAction>
#include <QMenu>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace handway::gui {
namespace {

// Adds a program under a name of its own. A program without a name was the only one: it gets one.
void add_program(geometric::Program program, std::vector<geometric::Program>& programs) {
  const auto is_taken = [&](const std::string& name) {
    return std::ranges::count(programs, name, &geometric::Program::name) > 0;
  };
  for (geometric::Program& other : programs) {
    if (other.name.empty()) {
      other.name = "program";
    }
  }
  const std::string name = program.name;
  for (int number = 2; is_taken(program.name); ++number) {
    program.name = name + " " + std::to_string(number);
  }
  programs.push_back(std::move(program));
}

// Fills a menu with the programs of the scene.
void list_programs(QMenu& menu, const geometric::Scene* scene, TaskTool& tool) {
  menu.clear();
  for (const geometric::Program& program :
       scene ? scene->programs : std::vector<geometric::Program>()) {
    QAction* action = menu.addAction(title_of(program), &tool,
                                     [&tool, name = program.name] { tool.begin_program(name); });
    action->setToolTip(words_of(program));
  }
  menu.addSeparator();
  QAction* make = menu.addAction(QObject::tr("&New program"), &tool, &TaskTool::begin_new_program);
  make->setToolTip(QObject::tr("Add a program to the scene, and edit its steps"));
  menu.setEnabled(scene != nullptr && !scene->robots.empty());
}

// Words for the stage in which a simulation lost the object.
QString moment_of_loss(const SimulatedTask& simulated, const FilmedTask& task) {
  const planning::StageKind kind = task.plan.stages[simulated.frames.back().moment.stage].kind;
  switch (kind) {
    case planning::StageKind::kLift:
      return QObject::tr("while it is lifted");
    case planning::StageKind::kLower:
      return QObject::tr("while it is lowered");
    default:
      return QObject::tr("while it is carried");
  }
}

// Returns whether the objects stand where the task puts them: a robot has run it.
bool is_done(const FilmedTask& task, const planning::SceneState& state) {
  return task.plan.solved && std::ranges::all_of(task.objects, [&](const std::string& name) {
           const auto* object = state.find(name);
           const auto* placed = task.plan.stages.back().state.find(name);
           return object && placed && object->X_PO.isApprox(placed->X_PO);
         });
}

QString verdict_of(const SimulatedTask& simulated, const FilmedTask& task,
                   const planning::HoldConditions& conditions) {
  const planning::CarryResult& result = simulated.result;
  const QString assumed = QObject::tr("Simulated with %1 kg and friction %2: ")
                              .arg(conditions.mass)
                              .arg(conditions.contact.friction);
  if (!result.squeeze.held) {
    return assumed + QObject::tr("the object slips away when the hand squeezes it.");
  }
  if (!result.held()) {
    return assumed + QObject::tr(
                         "the object is lost after %1 s, %2. Carry it more slowly, or give "
                         "its mass before planning.")
                         .arg(result.time, 0, 'f', 2)
                         .arg(moment_of_loss(simulated, task));
  }
  double largest = 0.0;
  for (const planning::LinkForce& force : result.forces) {
    largest = std::max(largest, force.largest);
  }
  return assumed + QObject::tr(
                       "the object is held. It slips by %1 mm and %2°; a link pushes with up "
                       "to %3 N, a joint with %4 % of its torque.")
                       .arg(geometric::millimetres(result.slip.shift), 0, 'f', 1)
                       .arg(geometric::degrees(result.slip.turn), 0, 'f', 1)
                       .arg(largest, 0, 'f', 1)
                       .arg(100.0 * result.torque_share, 0, 'f', 0);
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
  connect(&card_->film(), &FilmBar::shown, this, &TaskTool::show_frame);
  connect(&card_->film(), &FilmBar::pictures_wanted, this,
          [this] { emit pictures_wanted(film()); });
  connect(&card_->film(), &FilmBar::ended, this, &TaskTool::show_scene);
  connect(card_, &TaskCard::plan_wanted, this, &TaskTool::start);
  connect(card_, &TaskCard::changed, this, &TaskTool::ask_again);
  connect(card_, &TaskCard::row_chosen, this, &TaskTool::show_row);
  connect(card_, &TaskCard::steps_edited, this, &TaskTool::change_steps);
  connect(card_, &TaskCard::simulation_wanted, this, &TaskTool::simulate);
  connect(card_, &TaskCard::play_wanted, this,
          [this](bool wanted) { wanted ? play(task_.value.frames) : card_->film().end(); });
  connect(card_, &TaskCard::export_wanted, this, &TaskTool::ask_for_export);
  connect(card_, &TaskCard::run_wanted, this, [this] {
    card_->film().end();
    emit run_wanted(source());
  });
  connect(card_, &TaskCard::keep_wanted, this, &TaskTool::keep_or_remove);
  connect(card_, &TaskCard::closed, this, &TaskTool::end);
  connect(card_, &TaskCard::stop_wanted, this, &TaskTool::stop);
  connect(&simulation_job_, &LatestJob::failed, card_, &TaskCard::show_simulated);
  connect(&job_, &LatestJob::failed, this,
          [this](const QString& reason) { card_->show_failure(reason, {}); });
  connect(&document_, &Document::opened, this, &TaskTool::end);
  connect(&document_, &Document::edited, this, [this](const planning::SceneState& before) {
    if (before.scene != document_.scene() && !is_keeping_ && !card_->isHidden()) {
      follow_edit();
    }
  });
}

void TaskTool::begin() {
  const geometric::SceneObject* object = editor_.selected_object();
  if (object == nullptr || !document_.robot()) {
    return;
  }
  end();
  objects_ = {object->name};
  card_->ask(tr("Pick and place %1").arg(QString::fromStdString(object->name)),
             supports_of(*object), plugins_.hold_test_maker() != nullptr);
}

void TaskTool::begin_new_program() {
  if (!document_.robot()) {
    return;
  }
  geometric::Scene scene = *document_.scene();
  add_program({scene.programs.empty() ? "" : "program", {geometric::PostureStep{"start"}}},
              scene.programs);
  apply(tr("Add program"), std::move(scene));
  begin_program(document_.scene()->programs.back().name);
  card_->edit_steps();
}

void TaskTool::begin_program(const std::string& name) {
  end();
  const geometric::Program* program = find_program(name);
  if (program == nullptr || !document_.robot()) {
    return;
  }
  try {
    take_program(*program);
    card_->ask_program(*program, step_names(), plugins_.hold_test_maker() != nullptr);
  } catch (const geometric::InputError& error) {
    emit failed(title_of(*program), QString::fromUtf8(error.what()));
  }
}

const geometric::Program* TaskTool::find_program(const std::string& name) const {
  const std::vector<geometric::Program>& programs = document_.scene()->programs;
  const auto found = std::ranges::find(programs, name, &geometric::Program::name);
  return found == programs.end() ? nullptr : &*found;
}

void TaskTool::take_program(const geometric::Program& program) {
  objects_ = picked_objects(planning::task_of(program, *document_.scene()));
  program_ = program;
}

QStringList TaskTool::supports_of(const geometric::SceneObject& object) const {
  QStringList supports;
  for (const std::string& name : planning::supports_of(*document_.scene(), object)) {
    supports.push_back(QString::fromStdString(name));
  }
  return supports;
}

void TaskTool::follow_edit() {
  const bool was_run = is_done(task_.value, document_.state());
  const Steps steps = update_steps();
  if (steps == Steps::kGone) {
    end();
  } else if (steps == Steps::kTheSame && follows_ && !was_run) {
    plan_steps(true);
  } else {
    ask_again();
  }
}

TaskTool::Steps TaskTool::update_steps() {
  if (!document_.robot()) {
    return Steps::kGone;
  }
  if (program_) {
    return update_program();
  }
  const auto* object = geometric::find_object(*document_.scene(), objects_.front());
  if (object == nullptr || object->attachment) {
    return Steps::kGone;
  }
  return card_->update_supports(supports_of(*object)) ? Steps::kTheSame : Steps::kChanged;
}

TaskTool::Steps TaskTool::update_program() {
  const geometric::Program* program = find_program(program_->name);
  if (program == nullptr) {
    return Steps::kGone;
  }
  const QString before = words_of(*program_);
  try {
    take_program(*program);
  } catch (const geometric::InputError&) {
    return Steps::kGone;  // the menu of programs says why
  }
  card_->show_program(*program, step_names());
  return words_of(*program) == before ? Steps::kTheSame : Steps::kChanged;
}

StepNames TaskTool::step_names() const {
  const geometric::Scene& scene = *document_.scene();
  StepNames names;
  for (const geometric::SceneObject& object : scene.objects) {
    if (!object.attachment) {
      names.objects << QString::fromStdString(object.name);
    }
  }
  for (const std::string& name : geometric::standing_names(scene)) {
    names.supports << QString::fromStdString(name);
    names.X_WF[name] = *geometric::standing_pose(scene, name);
  }
  add_links(names);
  for (const std::string& posture : planning::posture_names(scene)) {
    names.postures << QString::fromStdString(posture);
  }
  return names;
}

void TaskTool::add_links(StepNames& names) const {
  const geometric::RobotInstance& robot = *document_.robot();
  const geometric::RobotModel& model = *robot.model;
  geometric::PoseGoal& goal = names.pose_here.goal;
  for (int link = 1; link < model.link_count(); ++link) {
    if (!geometric::chain_variables(model, link).empty()) {
      names.links << QString::fromStdString(model.link(link).name);
      goal.link = model.link(link).name;
    }
  }
  if (document_.palm() > 0) {
    goal.link = model.link(document_.palm()).name;
  }
  goal.X_WG =
      geometric::link_pose(*document_.scene(), document_.configuration(), robot.name, goal.link)
          .value_or(geometric::Pose::Identity());
}

void TaskTool::change_steps(const std::vector<geometric::ProgramStep>& steps, const QString& what) {
  geometric::Scene scene = *document_.scene();
  const auto program = std::ranges::find(scene.programs, program_->name, &geometric::Program::name);
  program->steps = steps;
  apply(what, std::move(scene));
}

void TaskTool::show_row(int row) {
  const planning::TaskPlan& plan = task_.value.plan;
  const auto index = static_cast<std::size_t>(row);
  if (plan.solved) {
    show_stage(index);
  } else if (index < plan.trials.size()) {
    show_trial(index);
  }
}

void TaskTool::show_stage(std::size_t stage) {
  if (!card_->film().is_open()) {
    play(task_.value.frames);
  }
  const auto first = std::ranges::find_if(
      frames_, [stage](const TaskFrame& frame) { return frame.moment.stage == stage; });
  if (first != frames_.end()) {
    card_->film().pause_at(static_cast<int>(first - frames_.begin()));
  }
}

void TaskTool::show_trial(std::size_t trial) {
  if (std::exchange(shown_trial_, trial) == trial) {
    hide_trial();
    card_->show_reason();
    return;
  }
  const planning::StageTrials& shown = task_.value.plan.trials[trial];
  card_->show_trial(shown);
  emit handles_welcome(false);
  view_.set_configuration(shown.q.size() > 0 ? shown.q : document_.configuration());
}

void TaskTool::hide_trial() {
  if (std::exchange(shown_trial_, std::nullopt)) {
    show_scene();
  }
}

geometric::Program TaskTool::shown_program() const {
  if (program_) {
    return *program_;
  }
  geometric::Program program{"place " + objects_.front(),
                             {geometric::PickStep{objects_.front()},
                              geometric::PlaceStep{{card_->support().toStdString()}}}};
  if (card_->returns()) {
    program.steps.emplace_back(geometric::PostureStep{"start"});
  }
  return program;
}

void TaskTool::keep_or_remove() {
  geometric::Scene scene = *document_.scene();
  if (program_) {
    std::erase_if(scene.programs, [this](const geometric::Program& program) {
      return program.name == program_->name;
    });
    apply(tr("Remove program"), std::move(scene));
    return;
  }
  add_program(shown_program(), scene.programs);
  is_keeping_ = true;
  apply(tr("Keep program"), std::move(scene));
  is_keeping_ = false;
  task_.made_from = document_.revision();  // nothing else was edited
  program_ = document_.scene()->programs.back();
  card_->show_program(*program_, step_names());
}

void TaskTool::apply(const QString& text, geometric::Scene scene) {
  planning::SceneState next = editor_.state();
  next.scene = std::make_shared<const geometric::Scene>(std::move(scene));
  editor_.apply(text, std::move(next), editor_.selected_objects());
}

void TaskTool::start() {
  grasps_.clear();
  plan_steps(false);
}

void TaskTool::plan_steps(bool again) {
  forget_plan();
  follows_ = true;
  card_->show_planning(again);
  planning::SceneState state = editor_.state();
  if (!state.scene->start) {  // the task begins where the robot is shown
    geometric::Scene scene = *state.scene;
    scene.start = document_.configuration();
    state.scene = std::make_shared<const geometric::Scene>(std::move(scene));
  }
  FilmedTask begun;
  begun.objects = objects_;
  begun.task = planning::task_of(shown_program(), *state.scene);
  begun.timing.speed = card_->speed();
  job_.run([this, state, begun = std::move(begun), mass = card_->mass(), again, grasps = grasps_,
            revision = document_.revision()](const std::stop_token& stop) -> LatestJob::Answer {
    const auto& planners = plugins_.planners();
    const auto planner = planners.create(planners.names().front());
    planning::TaskOptions options;
    options.threads = 2;
    options.grasps.payload = mass;
    options.first_grasps = grasps;
    FilmedTask filmed = begun;
    try {
      filmed.plan = plan_task(state, filmed.task, *planner, options, stop);
      add_film(filmed, stop);
    } catch (const geometric::PreparationStopped&) {
      return nullptr;
    }
    return [this, again, filmed = planning::Derived<FilmedTask>{std::move(filmed), revision}] {
      take(filmed, again);
    };
  });
}

void TaskTool::take(const planning::Derived<FilmedTask>& task, bool again) {
  if (task.made_from != document_.revision()) {
    card_->show_failure(tr("The scene was edited meanwhile. Plan again."), {});
    return;
  }
  task_ = task;
  const planning::TaskPlan& plan = task_.value.plan;
  if (plan.solved) {
    grasps_ = grasps_of(task_.value.task, plan);
    card_->show_plan(task_.value.stages, plan.time_s);
    if (!again) {
      play(task_.value.frames);
    }
  } else {
    card_->show_failure(QString::fromStdString(plan.reason), plan.trials);
  }
}

void TaskTool::simulate() {
  card_->film().end();
  if (simulation_) {
    play(simulation_->frames);
    return;
  }
  card_->show_simulating();
  planning::HoldConditions conditions;
  conditions.mass = card_->mass();
  simulation_job_.run([this, conditions, task = task_, make = plugins_.hold_test_maker()](
                          const std::stop_token& stop) -> LatestJob::Answer {
    SimulatedTask simulated = gui::simulate(task.value, make, conditions, stop);
    if (stop.stop_requested()) {
      return nullptr;
    }
    return [this, conditions, simulated = std::move(simulated)] {
      simulation_ = simulated;
      card_->show_simulated(verdict_of(simulated, task_.value, conditions));
      play(simulation_->frames);
    };
  });
}

void TaskTool::stop() {
  if (simulation_job_.is_busy()) {
    simulation_job_.cancel();
    card_->show_simulated(tr("The simulation was stopped."));
  } else {
    job_.cancel();
    follows_ = false;
    card_->show_failure(tr("The search was stopped."), {});
  }
}

void TaskTool::play(const std::vector<TaskFrame>& frames) {
  card_->film().end();
  frames_ = frames;
  emit handles_welcome(false);
  view_.preview_ghost(true, std::nullopt);
  view_.preview_ghost(false, std::nullopt);
  card_->film().begin(static_cast<int>(frames_.size()));
}

DerivedSource TaskTool::source() const {
  MotionSource source;
  source.title = tr("Export the task");
  source.name = QString::fromStdString(planning::motion_name(shown_program().name));
  source.time = [task = task_.value.task, plan = task_.value.plan](
                    const std::string& name, const planning::TimingOptions& options) {
    return whole_task(time_task(task, plan, name, options));
  };
  std::ranges::transform(task_.value.plan.stages, std::back_inserter(source.scenes),
                         &planning::TaskStage::state);
  return {std::move(source), task_.made_from};
}

void TaskTool::ask_for_export() {
  card_->film().end();
  emit export_wanted(source());
}

Film TaskTool::film() const {
  std::vector<SceneItem> items;
  std::ranges::transform(objects_, std::back_inserter(items), object_item);
  const auto moment = [items](const TaskFrame& frame) {
    FilmMoment shown{frame.moment.q, {}, frame.forces};
    for (std::size_t i = 0; i < frame.X_WO.size(); ++i) {
      shown.X_WO.emplace_back(items[i], frame.X_WO[i]);
    }
    return shown;
  };
  return {tr("Export pictures of the task"),
          QString::fromStdString(planning::motion_name(shown_program().name)), document_.scene(),
          FilmBar::seconds(frames_.size()), nearest_of(frames_, moment)};
}

void TaskTool::show_frame(int index) {
  const TaskFrame& frame = frames_[static_cast<std::size_t>(index)];
  view_.set_configuration(frame.moment.q);
  for (std::size_t i = 0; i < frame.X_WO.size(); ++i) {
    view_.preview(object_item(objects_[i]), frame.X_WO[i]);
  }
  view_.set_overlay(Overlay::kGrasp,
                    frame.forces.empty() ? nullptr : make_forces_node(frame.forces));
  card_->show_played(static_cast<int>(frame.moment.stage));
}

void TaskTool::show_scene() {
  card_->show_played(-1);
  view_.set_overlay(Overlay::kGrasp, nullptr);
  const std::shared_ptr<const geometric::Scene> scene = document_.scene();
  for (const std::string& name : objects_) {
    if (const auto* object = scene ? geometric::find_object(*scene, name) : nullptr) {
      view_.preview(object_item(name), object->X_PO);
    }
  }
  if (document_.robot()) {
    view_.set_configuration(document_.configuration());
    view_.preview_ghost(true, scene->start);
    view_.preview_ghost(false, scene->goal);
  }
  emit handles_welcome(true);
}

void TaskTool::forget_plan() {
  card_->film().end();
  hide_trial();
  job_.cancel();
  simulation_job_.cancel();
  follows_ = false;
  task_ = {};
  simulation_.reset();
  emit plan_forgotten();
}

void TaskTool::ask_again() {
  forget_plan();
  card_->ask_again();
}

void TaskTool::end() {
  forget_plan();
  program_.reset();
  card_->hide();
}

std::vector<QPoint> TaskTool::to_be_seen() const {
  std::vector<Eigen::Vector3d> places;
  const std::shared_ptr<const geometric::Scene> scene = document_.scene();
  for (const std::string& name : objects_) {
    if (const auto* object = scene ? geometric::find_object(*scene, name) : nullptr) {
      places.emplace_back(object->X_PO.translation());
    }
  }
  for (const TaskFrame& frame : task_.value.frames) {
    for (const geometric::Pose& X_WO : frame.X_WO) {
      places.emplace_back(X_WO.translation());
    }
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
  auto* programs = new QMenu(QObject::tr("Progra&ms"), &workbench.window);
  programs->setObjectName(QStringLiteral("programs"));
  programs->setToolTipsVisible(true);
  workbench.add_to_menu(MainMenu::kPlan, {0, 21}, programs->menuAction());
  const auto update_programs = [programs, &tool, &workbench] {
    list_programs(*programs, workbench.document.scene().get(), tool);
  };
  QObject::connect(&workbench.document, &Document::opened, programs, update_programs);
  QObject::connect(&workbench.document, &Document::edited, programs, update_programs);
  QObject::connect(&tool, &TaskTool::failed, &workbench, &Workbench::show_error);
  update_programs();
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
  QObject::connect(&tool, &TaskTool::pictures_wanted, &workbench, &Workbench::pictures_wanted);
  QObject::connect(&tool, &TaskTool::run_wanted, &workbench, &Workbench::run_wanted);
  QObject::connect(&tool, &TaskTool::plan_forgotten, &workbench, &Workbench::task_forgotten);
  QObject::connect(&tool, &TaskTool::handles_welcome, &workbench, &Workbench::handles_welcome);
  QObject::connect(&workbench.document, &Document::opened, pick, update_enabled);
  QObject::connect(&workbench.document, &Document::edited, pick, update_enabled);
  QObject::connect(&workbench.editor, &SceneEditor::selection_changed, pick, update_enabled);
  workbench.add_work([&tool] { return tool.is_busy(); });
  update_enabled();
}

}  // namespace handway::gui
