#include "features/planning/planning_commands.h"

#include "features/planning/collision_display.h"
#include "features/planning/group_choice.h"
#include "features/planning/plan_panel.h"
#include "features/planning/preset_bar.h"
#include "features/planning/projection_panel.h"
#include "features/planning/projection_tool.h"
#include "features/planning/query_check.h"
#include "features/planning/region_tool.h"
#include "features/planning/roadmap_display.h"
#include "features/workbench.h"
#include "model/planning/plan_settings.h"
#include "model/playback/path_timeline.h"
#include "view3d/scene_view.h"
#include "widgets/panels/log_panel.h"
#include "widgets/style/actions.h"

#include <QMainWindow>
#include <QStatusBar>

namespace handway::gui {

PlanningCommands::PlanningCommands(Workbench& workbench, PlanPanel& panel)
    : workbench_(workbench),
      panel_(panel),
      plan_(workbench.make_action("route", tr("&Plan"), QKeySequence(QStringLiteral("Ctrl+P")),
                                  tr("Find a path from start to goal"))),
      cancel_(workbench.make_action("cancel", tr("&Cancel"), QKeySequence(Qt::Key_Escape),
                                    tr("Stop planning"))),
      optimize_(workbench.make_action("", tr("Continue &optimising"),
                                      QKeySequence(QStringLiteral("Ctrl+Alt+P")),
                                      tr("Make the path that is shown better for the planner's "
                                         "objective"))),
      roadmap_shown_(workbench.make_action(
          "samples", tr("&Roadmap"), QKeySequence(Qt::Key_N),
          tr("Show the nodes of the planner, at the positions of the palm, and its edges"))),
      hypercubes_shown_(workbench.make_action(
          "", tr("Sampling &cells"), QKeySequence(QStringLiteral("Shift+N")),
          tr("Show the positions of the palm in the sampling cells (hypercubes)"))) {
  optimize_->setObjectName(QStringLiteral("optimize_action"));
  hypercubes_shown_->setObjectName(QStringLiteral("hypercubes"));
  roadmap_shown_->setCheckable(true);
  hypercubes_shown_->setCheckable(true);
  allow(*cancel_, tr("No planner is running."));
  allow(*optimize_, tr("Plan or open a path first."));
  place_actions();
  connect_session();
  const auto show_planners = [this] {
    update_ready();
    if (workbench_.document.scene()) {
      panel_.show_planners_that_serve(workbench_.document.loaded().basis != nullptr);
    }
  };
  connect(&workbench_, &Workbench::scene_shown, this, show_planners);
  connect(&workbench_.document, &Document::hand_changed, this, show_planners);
  connect(&workbench_.document, &Document::edited, this, &PlanningCommands::update_ready);
  connect(&workbench_.document, &Document::measured_shown, this, &PlanningCommands::show_validity);
  connect(&workbench_.validity, &PathValidity::changed, this, &PlanningCommands::show_validity);
  connect(&panel_, &PlanPanel::runs_requested, this, [this] { workbench_.show_panel("runs"); });
  connect(&panel_.presets(), &PresetBar::failed, &workbench_, &Workbench::show_error);
  report_presets();
}

void PlanningCommands::place_actions() {
  int order = 0;
  for (QAction* action : {plan_, cancel_, optimize_}) {
    workbench_.add_to_menu(MainMenu::kPlan, {0, ++order}, action);
  }
  workbench_.add_to_menu(MainMenu::kView, {1, 1}, roadmap_shown_);
  workbench_.add_to_menu(MainMenu::kView, {1, 2}, hypercubes_shown_);
  workbench_.add_to_bar(MainBar::kTools, {1, 0}, plan_, true);
  workbench_.add_to_bar(MainBar::kTools, {1, 1}, cancel_, true);
  workbench_.add_to_bar(MainBar::kTools, {3, 10}, roadmap_shown_);
}

void PlanningCommands::connect_session() {
  PlanningSession& session = workbench_.session;
  connect(plan_, &QAction::triggered, &session, &PlanningSession::start);
  connect(cancel_, &QAction::triggered, &session, &PlanningSession::cancel);
  connect(optimize_, &QAction::triggered, &session, &PlanningSession::optimize);
  connect(&session, &PlanningSession::optimizing_started, this, [this] {
    show_running();
    workbench_.log.add(LogPanel::Level::kNote, tr("Optimising the path"));
  });
  connect(&session, &PlanningSession::started, this, &PlanningCommands::show_start);
  connect(&session, &PlanningSession::ended, this, &PlanningCommands::show_end);
  connect(&session, &PlanningSession::path_changed, this, &PlanningCommands::show_path);
  connect(&session, &PlanningSession::path_optimized, this, &PlanningCommands::show_optimized);
}

void PlanningCommands::report_presets() {
  if (const QString fault = panel_.presets().store().fault(); !fault.isEmpty()) {
    workbench_.show_error(
        tr("Your presets can't be read"),
        tr("%1. The file is unchanged; it is renamed when a preset is saved.").arg(fault));
  }
}

void PlanningCommands::update_ready() {
  const auto& scene = workbench_.document.scene();
  const bool has_query = workbench_.document.robot() && (scene->goal || !scene->goal_poses.empty());
  why_not_ = has_query ? QString()
             : !scene  ? tr("Open a scene first.")
             : !workbench_.document.robot()
                 ? tr("The scene has no robot: add one with Add > Robot.")
                 : tr("The scene has no goal. Pose the robot with the Joints panel and choose\n"
                      "Plan > Set goal here, or select an object and press Ctrl+G to grasp it.");
  panel_.set_ready(has_query, why_not_);
  allow(*plan_, workbench_.session.is_running() ? tr("A planner is running.") : why_not_);
}

void PlanningCommands::show_running() {
  allow(*plan_, tr("A planner is running."));
  allow(*cancel_, {});
}

void PlanningCommands::show_start() {
  show_running();
  const PlanSettings& settings = workbench_.plan_settings;
  const qulonglong first = settings.request().seed;
  const QString seeds = settings.seeds() > 1
                            ? tr("seeds %1 to %2")
                                  .arg(first)
                                  .arg(first + static_cast<qulonglong>(settings.seeds()) - 1)
                            : tr("seed %1").arg(first);
  workbench_.log.add(
      LogPanel::Level::kNote,
      tr("Planning with %1, %2").arg(QString::fromStdString(settings.planner()->name()), seeds));
}

void PlanningCommands::show_end(bool solved, const QString& text) {
  allow(*plan_, why_not_);
  allow(*cancel_, tr("No planner is running."));
  workbench_.log.add(solved ? LogPanel::Level::kNote : LogPanel::Level::kWarning, text);
}

void PlanningCommands::show_path() {
  const Document& document = workbench_.document;
  const PalmPath path =
      document.robot() ? palm_path(*document.robot(), workbench_.player.timeline(), document.palm())
                       : PalmPath{};
  workbench_.view.set_path(path.points, path.waypoints);
}

void PlanningCommands::show_optimized(const planning::Path& path) {
  const Document& document = workbench_.document;
  const PalmPath palm =
      !path.empty() && document.robot()
          ? palm_path(*document.robot(), PathTimeline(*document.robot()->model, path),
                      document.palm())
          : PalmPath{};
  workbench_.view.set_optimized(palm.points, palm.waypoints);
}

void PlanningCommands::show_validity() {
  const bool valid = workbench_.validity.state() == PathValidity::State::kValid;
  allow(*optimize_, valid ? QString() : tr("No path is valid in this scene. Plan one first."));
  panel_.set_optimizable(valid);
  panel_.show_validity(workbench_.validity.reason());
}

void add_planning(Workbench& workbench) {
  auto* panel = new PlanPanel(workbench.plan_settings);
  workbench.add_dock(DockArea::kControl, 0, {"plan", QObject::tr("Plan"), panel});
  panel->follow(workbench.session);
  panel->follow(workbench.history);
  auto& settings = workbench.own<SettingsHistory>(workbench.plan_settings, workbench.editor);
  QObject::connect(&workbench, &Workbench::ready, &settings, &SettingsHistory::begin);
  auto& collisions = workbench.own<CollisionDisplay>(workbench.collisions, workbench.view);
  workbench.window.statusBar()->addWidget(collisions.label(), 1);
  workbench.add_to_menu(MainMenu::kView, {1, 3}, collisions.closest_shown());
  QObject::connect(&workbench, &Workbench::scene_shown, &collisions, &CollisionDisplay::show_scene);
  QObject::connect(&collisions, &CollisionDisplay::failed, &workbench,
                   [&workbench](const QString& message) {
                     workbench.log.add(LogPanel::Level::kError, message);
                   });
  panel->add_row(PlanPanel::tr("Moves"), new GroupChoice(workbench.editor));
  workbench.own<RegionTool>(workbench.document, workbench.plan_settings, *panel, workbench.view);
  auto& projection = workbench.own<ProjectionTool>(workbench.document, workbench.player);
  workbench.add_dock(DockArea::kBelow, 3,
                     {"projection", QObject::tr("Projection"), projection.panel()});
  auto& commands = workbench.own<PlanningCommands>(workbench, *panel);
  auto& hypercubes = workbench.own<HypercubeDisplay>(workbench.document, workbench.plan_settings,
                                                     workbench.session, workbench.view,
                                                     commands.hypercubes_shown());
  workbench.own<RoadmapDisplay>(workbench.session, workbench.view, commands.roadmap_shown(),
                                hypercubes, commands.hypercubes_shown());
  workbench.own<FrontierDisplay>(workbench.document, workbench.session, workbench.view);
  projection.follow(workbench.session);
  auto& query = workbench.own<QueryCheck>(workbench.document, workbench.editor, workbench.posing,
                                          workbench.view);
  workbench.add_work([&query] { return query.is_busy(); });
  QObject::connect(&query, &QueryCheck::warned, &workbench, [&workbench](const QStringList& all) {
    for (const QString& warning : all) {
      workbench.log.add(LogPanel::Level::kWarning, warning);
    }
  });
}

}  // namespace handway::gui
