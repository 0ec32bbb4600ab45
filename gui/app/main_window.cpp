#include "app/main_window.h"

#include "app/file_commands.h"
#include "app/frame_rate_label.h"
#include "app/planning_commands.h"
#include "app/playback_tools.h"
#include "app/preference_effects.h"
#include "app/start/command_palette.h"
#include "app/start/help.h"
#include "app/start/start_page.h"
#include "app/view_actions.h"
#include "features/campaigns/campaigns_panel.h"
#include "features/devices/device_session.h"
#include "features/devices/devices_panel.h"
#include "features/editing/palm_tool.h"
#include "features/editing/properties_panel.h"
#include "features/editing/recovery.h"
#include "features/editing/scene_editing.h"
#include "features/editing/scene_tree.h"
#include "features/export/export_dialog.h"
#include "features/glove/glove_panel.h"
#include "features/grasping/grasp_tool.h"
#include "features/planning/collision_display.h"
#include "features/planning/plan_panel.h"
#include "features/planning/planning_views.h"
#include "features/planning/query_check.h"
#include "features/postures/joint_panel.h"
#include "features/postures/kept_postures.h"
#include "features/postures/pmd_panel.h"
#include "features/postures/posture_panels.h"
#include "features/preferences/preferences_dialog.h"
#include "features/runs/runs_panel.h"
#include "features/tracker/wrist_page.h"
#include "handway/geometric/formats/mesh_reader.h"
#include "model/planning/path_validity.h"
#include "model/playback/path_timeline.h"
#include "view3d/scene_view.h"
#include "widgets/forms/wheel_guard.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/panels/floating_card.h"
#include "widgets/panels/playback_bar.h"
#include "widgets/style/theme.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QMenu>
#include <QMenuBar>
#include <QMimeData>
#include <QPushButton>
#include <QStackedWidget>
#include <QStatusBar>
#include <QUndoView>

namespace handway::gui {

MainWindow::MainWindow(std::shared_ptr<planning::Extensions> extensions, QWidget* parent)
    : QMainWindow(parent),
      extensions_(std::move(extensions)),
      document_(extensions_),
      editor_(document_),
      posing_(document_, player_),
      plan_settings_(extensions_->planners()),
      view_(new SceneView),
      middle_(new QStackedWidget),
      banner_(new Banner(middle_)),
      log_(new LogPanel),
      plan_panel_(new PlanPanel(plan_settings_)),
      campaigns_(new CampaignsPanel(extensions_)),
      postures_(std::make_unique<PosturePanels>(document_, posing_)),
      glove_(new GlovePanel),
      wrist_(new WristPage),
      devices_(std::make_unique<DeviceSession>(document_, player_)),
      collisions_(std::make_unique<CollisionDisplay>(document_, *view_)),
      planning_views_(std::make_unique<PlanningViews>(document_, player_, plan_settings_,
                                                      *plan_panel_, *view_)),
      playback_(new PlaybackBar(player_)),
      start_page_(new StartPage),
      palette_(new CommandPalette(*this)),
      actions_(std::make_unique<WindowActions>(*this)),
      body_display_(std::make_unique<BodyDisplayTool>(document_, *view_)),
      view_actions_(
          std::make_unique<ViewActions>(*this, *actions_, *view_, *body_display_, preferences_)),
      playback_tools_(std::make_unique<PlaybackTools>(
          PlaybackParts{*this, *actions_, document_, player_, *view_, *playback_, plan_settings_})),
      editing_(std::make_unique<SceneEditing>(
          EditingParts{*this, *actions_->edit_menu(), *actions_->add_menu(), *actions_->edit_bar(),
                       editor_, *view_, collisions_->monitor()})),
      files_(
          std::make_unique<FileCommands>(*this, document_, plan_settings_, editor_.undo_stack())),
      recovery_(std::make_unique<Recovery>(document_, editor_, plan_settings_, *banner_)) {
  setWindowTitle(tr("Handway"));
  setAcceptDrops(true);
  new WheelGuard(this);
  build_docks();
  session_ = std::make_unique<PlanningSession>(document_, plan_settings_, player_);
  plan_panel_->follow(*session_);
  validity_ = std::make_unique<PathValidity>(player_);
  planning_views_->follow(*session_, *actions_->samples, *actions_->hypercubes);
  query_check_ = std::make_unique<QueryCheck>(document_, editor_, posing_, *view_);
  grasp_tool_ = std::make_unique<GraspTool>(document_, editor_, *session_, *view_);
  palm_tool_ = std::make_unique<PalmTool>(document_, editor_, posing_, *session_, *view_);
  view_->set_colors(colors_of(current_theme()).view);
  preference_effects_ =
      std::make_unique<PreferenceEffects>(preferences_, *view_, plan_settings_, *recovery_);
  connect_actions();
  connect_start();
  connect_document();
  connect_view();
  connect_glove();
  connect_planning();
  connect_devices();
  connect_campaigns();
  new ConstraintDisplay(document_, *view_, this);  // shows a scene after the view does
  show_scene();
  planning_commands_->tell_of_presets();
  for (const planning::RefusedPlugin& plugin : extensions_->refused()) {
    log_->add(LogPanel::Level::kWarning,
              tr("Plugin %1 was not taken: %2")
                  .arg(QString::fromStdString(plugin.file.filename().string()),
                       QString::fromStdString(plugin.reason)));
  }
}

MainWindow::~MainWindow() = default;

CollisionMonitor& MainWindow::collisions() { return collisions_->monitor(); }

void MainWindow::build_docks() {
  playback_->setProperty("role", "playback");
  middle_->addWidget(start_page_);
  middle_->addWidget(stacked({view_, playback_}, 0));
  setCentralWidget(middle_);
  auto* history = new QUndoView(&editor_.undo_stack());
  history->setEmptyLabel(tr("As opened"));
  gui::build_docks(*this,
                   {.left = {{"scene", tr("Scene"), &editing_->tree(), 290},
                             {"properties", tr("Properties"), editing_->properties(), 350},
                             {"messages", tr("Messages"), log_, 110}},
                    .history = {"history", tr("History"), history},
                    .control = {{"plan", tr("Plan"), plan_panel_},
                                {"joints", tr("Joints"),
                                 stacked({postures_->postures(), postures_->joints()}, 1)},
                                {"hand", tr("Hand"), postures_->hand()},
                                {"glove", tr("Glove"), glove_},
                                {"devices", tr("Devices"), devices_->panel()},
                                {"campaigns", tr("Campaigns"), campaigns_}},
                    .below = playback_tools_->docks(
                        {"projection", tr("Projection"), planning_views_->projection_panel()})},
                   *actions_->view_menu(), *actions_->edit_menu());
  actions_->view_menu()->addActions({collisions_->closest_shown(), actions_->default_layout});
  statusBar()->addWidget(collisions_->label(), 1);
  statusBar()->addPermanentWidget(new FrameRateLabel(*view_));
  // The corner that is on the screen even if the window is larger.
  menuBar()->setCornerWidget(devices_->stop_button(), Qt::TopLeftCorner);
  default_layout_ = saveState();
  restore_layout(*this);
}

void MainWindow::connect_actions() {
  connect(actions_->open, &QAction::triggered, this, [this] {
    if (const QString file = files_->choose(); !file.isEmpty()) {
      open(file);
    }
  });
  connect(actions_->recent, &RecentFiles::chosen, this, &MainWindow::open);
  connect(actions_->save, &QAction::triggered, files_.get(), &FileCommands::save);
  connect(actions_->save_as, &QAction::triggered, files_.get(), &FileCommands::save_as);
  connect(files_.get(), &FileCommands::saved, this, [this](const QString& file) {
    actions_->recent->add(file);
    log_->add(LogPanel::Level::kNote, tr("Saved as %1").arg(file));
    update_title();
  });
  connect(files_.get(), &FileCommands::failed, this, &MainWindow::show_error);
  connect(actions_->picture, &QAction::triggered, this, [this] { files_->save_picture(*view_); });
  connect(actions_->quit, &QAction::triggered, this, &QWidget::close);
  connect(playback_tools_.get(), &PlaybackTools::failed, this, &MainWindow::show_error);
  connect(playback_tools_.get(), &PlaybackTools::exported, this, [this](const QString& file) {
    log_->add(LogPanel::Level::kNote, tr("Exported %1").arg(file));
  });
  actions_->dark->setChecked(current_theme() == Theme::kDark);
  connect(actions_->dark, &QAction::toggled, this, [this](bool dark) {
    show_theme(dark ? Theme::kDark : Theme::kLight);
    preferences_.set(&PreferenceValues::theme, current_theme());
  });
  connect(preference_effects_.get(), &PreferenceEffects::theme_changed, this,
          &MainWindow::show_theme);
  connect(actions_->preferences, &QAction::triggered, this,
          [this] { show_preferences(preferences_, extensions_->planners().names(), *this); });
  connect(actions_->about, &QAction::triggered, this, [this] { show_about(*this); });
}

void MainWindow::connect_start() {
  connect(start_page_, &StartPage::open_requested, this, &MainWindow::open);
  connect(start_page_, &StartPage::browse_requested, actions_->open, &QAction::trigger);
  connect(start_page_, &StartPage::new_requested, this, &MainWindow::create);
  connect(actions_->create, &QMenu::triggered, this,
          [this](QAction* robot) { create(robot->data().toString().toStdString()); });
  connect(actions_->palette, &QAction::triggered, palette_, &CommandPalette::ask);
  connect(actions_->help, &QAction::triggered, this, [this] { show_panel_help(*this); });
  connect(actions_->default_layout, &QAction::triggered, this,
          [this] { restoreState(default_layout_); });
  connect(actions_->set_start, &QAction::triggered, this,
          [this] { editor_.set_start(document_.configuration()); });
  connect(actions_->set_goal, &QAction::triggered, this,
          [this] { editor_.set_goal(document_.configuration()); });
  new KeptPostures(document_, editor_, *postures_->postures(), *actions_->keep_posture, this);
}

void MainWindow::connect_document() {
  connect(&document_, &Document::opening, this, [this](const QString& file) {
    statusBar()->showMessage(tr("Opening %1…").arg(QFileInfo(file).fileName()));
  });
  connect(&document_, &Document::opened, this, &MainWindow::show_scene);
  connect(&document_, &Document::edited, this, &MainWindow::update_ready);
  connect(&editor_.undo_stack(), &QUndoStack::cleanChanged, this,
          [this](bool clean) { setWindowModified(!clean); });
  connect(editing_.get(), &SceneEditing::failed, this, &MainWindow::show_error);
  connect(recovery_.get(), &Recovery::failed, this, [this](const QString& message) {
    log_->add(LogPanel::Level::kError, tr("Unsaved changes are not kept: %1").arg(message));
  });
  connect(&document_, &Document::open_failed, this, [this](const QString& message) {
    statusBar()->clearMessage();
    show_error(tr("The scene can't be opened"), message);
    emit failed(message);
  });
  connect(&document_, &Document::configuration_changed, view_, &SceneView::set_configuration);
  connect(collisions_.get(), &CollisionDisplay::failed, this,
          [this](const QString& message) { log_->add(LogPanel::Level::kError, message); });
}

void MainWindow::connect_view() {
  connect(&editing_->tree(), &SceneTree::ghosts_toggled, view_, &SceneView::show_ghosts);
  connect(&editing_->tree(), &SceneTree::posture_activated, this, [this](const SceneItem& item) {
    const auto& q =
        item.kind == SceneItem::Kind::kStart ? document_.scene()->start : document_.scene()->goal;
    posing_.set(*q);
  });
  connect(&editor_, &SceneEditor::selection_changed, postures_.get(), &PosturePanels::show_item);
}

void MainWindow::connect_glove() {
  glove_->add_page(tr("Wrist"), wrist_);
  connect(view_, &SceneView::frameSwapped, glove_, &GlovePanel::note_drawn);
  connect(glove_, &GlovePanel::posture_changed, &posing_, &Posing::apply);
  connect(&document_, &Document::configuration_changed, glove_, &GlovePanel::set_configuration);
  connect(&document_, &Document::configuration_changed, wrist_, &WristPage::set_configuration);
  connect(wrist_, &WristPage::posture_wanted, &glove_->guard(),
          [this](const geometric::NamedPosture& posture) {
            glove_->guard().propose(ContactGuard::Leader::kArm, posture);
          });
  connect(wrist_, &WristPage::released, &glove_->guard(),
          [this] { glove_->guard().withdraw(ContactGuard::Leader::kArm); });
}

void MainWindow::show_hand() {
  const geometric::RobotInstance* robot = document_.robot();
  const auto model = robot ? robot->model : nullptr;
  glove_->set_hand(model, document_.loaded().basis, document_.problem());
  wrist_->set_robot(model, document_.groups().arm);
}

void MainWindow::connect_planning() {
  planning_commands_ = std::make_unique<PlanningCommands>(*actions_, *session_, plan_settings_,
                                                          plan_panel_->presets(), *log_);
  runs_tool_ = std::make_unique<RunsTool>(playback_tools_->history(), *playback_tools_->runs(),
                                          *session_, plan_settings_, editor_);
  connect(plan_panel_, &PlanPanel::runs_requested, this,
          [this] { bring_to_front(*playback_tools_->runs()); });
  connect(planning_commands_.get(), &PlanningCommands::failed, this, &MainWindow::show_error);
  connect(editing_->actions().grasp, &QAction::triggered, grasp_tool_.get(), &GraspTool::begin);
  connect(grasp_tool_.get(), &GraspTool::handles_welcome, editing_.get(),
          &SceneEditing::show_handles);
  connect(editing_.get(), &SceneEditing::tried, session_.get(), &PlanningSession::try_scene);
  connect(session_.get(), &PlanningSession::path_changed, this, &MainWindow::show_path);
  connect(session_.get(), &PlanningSession::path_optimized, this, &MainWindow::show_optimized);
  const auto follow_scene = [this] { validity_->follow(document_.problem()); };
  connect(&document_, &Document::opened, this, follow_scene);
  connect(&document_, &Document::edited, this, follow_scene);
  connect(validity_.get(), &PathValidity::changed, this, &MainWindow::show_validity);
  connect(&document_, &Document::measured_shown, this, &MainWindow::show_validity);
  connect(session_.get(), &PlanningSession::ended, this, [this](bool solved) {
    if (solved && options_.play) {
      player_.play();
    }
  });
}

void MainWindow::export_path() {
  auto* dialog = new ExportDialog(extensions_, document_, player_.timeline().path(),
                                  files_->scene_name(), this);
  connect(dialog, &ExportDialog::exported, this, [this](const QStringList& files) {
    log_->add(LogPanel::Level::kNote, tr("Exported %1").arg(files.join(QStringLiteral(", "))));
  });
  dialog->open();
}

void MainWindow::connect_devices() {
  connect(actions_->export_path, &QAction::triggered, this, &MainWindow::export_path);
  connect(devices_.get(), &DeviceSession::executed_changed, view_,
          [this](const std::vector<Eigen::Vector3d>& way) { view_->set_executed(way); });
  connect(devices_.get(), &DeviceSession::reported, this,
          [this](bool good, const QString& message) {
            log_->add(good ? LogPanel::Level::kNote : LogPanel::Level::kError, message);
          });
  connect(devices_.get(), &DeviceSession::start_here_requested, this,
          [this](const Eigen::VectorXd& q) {
            editor_.set_start(q);
            session_->start();
          });
}

void MainWindow::begin(const Options& options) {
  options_ = options;
  if (options.screenshot.empty()) {
    recovery_->offer();
  }
  if (!options.scene.empty()) {
    document_.open(options.scene);
  } else {
    emit ready();
  }
}

bool MainWindow::may_leave() { return devices_->may_leave(*this) && files_->may_discard(); }

void MainWindow::open(const QString& file) {
  if (!may_leave()) {
    return;
  }
  options_ = {};
  document_.open(file.toStdString());
}

void MainWindow::create(const std::string& robot) {
  if (may_leave()) {
    options_ = {};
    document_.create(robot);
  }
}

// A run is its problem, planner, parameters and seed: planned again, it gives the same path.
void MainWindow::connect_campaigns() {
  connect(campaigns_, &CampaignsPanel::run_chosen, this, [this](const planning::ArchivedRun& run) {
    if (may_leave()) {
      options_ = {};
      options_.play = true;
      options_.planner = run.planner.planner;
      options_.settings = run.planner.parameters;
      options_.seed = run.record.spec.seed;
      document_.open(run.file);
    }
  });
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls() && event->mimeData()->urls().front().isLocalFile()) {
    event->acceptProposedAction();
  }
}

void MainWindow::dropEvent(QDropEvent* event) {
  const QString file = event->mimeData()->urls().front().toLocalFile();
  if (document_.scene() && geometric::is_mesh_file(file.toStdString())) {
    editing_->add_mesh(file);
  } else {
    open(file);
  }
}

void MainWindow::show_scene() {
  statusBar()->clearMessage();
  const auto& scene = document_.scene();
  collisions_->show_scene();
  view_->set_scene(scene);
  editing_->tree().set_scene(scene);
  postures_->show_robot();
  show_hand();
  update_ready();
  middle_->setCurrentIndex(scene ? 1 : 0);
  for (QAction* action : {actions_->set_start, actions_->set_goal, actions_->keep_posture}) {
    action->setEnabled(document_.robot() != nullptr);
  }
  actions_->save->setEnabled(scene != nullptr);
  actions_->save_as->setEnabled(scene != nullptr);
  if (!scene) {
    return;
  }
  banner_->hide_message();
  update_title();
  log_->add(LogPanel::Level::kNote, tr("Opened %1").arg(files_->scene_name()));
  for (const std::string& warning : scene->warnings) {
    log_->add(LogPanel::Level::kWarning, QString::fromStdString(warning));
  }
  if (!document_.file().empty()) {
    actions_->recent->add(QString::fromStdString(document_.file().string()));
  }
  try {
    plan_panel_->show_planners_that_serve(document_.loaded().basis != nullptr);
    apply_plan_options();
  } catch (const std::exception& error) {
    const QString message = QString::fromUtf8(error.what());
    show_error(tr("The planner can't be set up"), message);
    emit failed(message);
    return;
  }
  if (options_.play) {
    session_->start();
  }
  apply_glove_options();
  emit ready();
}

void MainWindow::update_ready() {
  const auto& scene = document_.scene();
  const bool has_query = scene && scene->start && scene->goal;
  plan_panel_->set_ready(
      has_query, scene ? tr("The scene has no start or no goal") : tr("Open a scene first"));
  actions_->plan->setEnabled(has_query && !session_->is_running());
}

void MainWindow::update_title() { setWindowTitle(tr("%1[*] – Handway").arg(files_->scene_name())); }

// What the options say of planning goes before what the scene says.
void MainWindow::apply_plan_options() {
  plan_settings_.apply(document_.scene()->planner);
  if (!options_.planner.empty()) {
    plan_settings_.choose_planner(options_.planner);
  }
  if (options_.seed) {
    plan_settings_.set_seed(*options_.seed);
    plan_settings_.set_seeds(1);
  }
  for (const auto& [key, value] : options_.settings) {
    plan_settings_.set_parameter(key, value);
  }
}

void MainWindow::apply_glove_options() {
  if (!options_.glove.empty() || !options_.glove_page.empty() || !options_.tracker.empty()) {
    glove_->come_to_front(QString::fromStdString(options_.glove_page));
    glove_->connect_to(QString::fromStdString(options_.glove));
    if (!options_.tracker.empty() && document_.scene()->start) {
      posing_.set(*document_.scene()->start);
    }
    wrist_->connect_to(QString::fromStdString(options_.tracker));
  }
}

void MainWindow::show_error(const QString& title, const QString& message) {
  log_->add(LogPanel::Level::kError, message);
  banner_->show_message(title, message);
}

QString MainWindow::message() const {
  return banner_->isVisible() ? banner_->message() : QString();
}

void MainWindow::show_path() {
  if (!document_.robot()) {
    view_->set_path({}, {});
    return;
  }
  const PalmPath path = palm_path(*document_.robot(), player_.timeline(), document_.palm());
  view_->set_path(path.points, path.waypoints);
}

void MainWindow::show_optimized(const planning::Path& path) {
  if (path.empty() || !document_.robot()) {
    view_->set_optimized({}, {});
    return;
  }
  const PalmPath palm = palm_path(*document_.robot(), PathTimeline(*document_.robot()->model, path),
                                  document_.palm());
  view_->set_optimized(palm.points, palm.waypoints);
}

void MainWindow::show_validity() {
  const bool valid = validity_->state() == PathValidity::State::kValid;
  actions_->export_path->setEnabled(valid);
  actions_->optimize->setEnabled(valid);
  plan_panel_->set_optimizable(valid);
  plan_panel_->show_validity(validity_->reason());
  if (!validity_->reason().isEmpty()) {
    playback_->show_note(tr("out of date"), validity_->reason());
  } else if (document_.shows_measured()) {
    playback_->show_note(tr("robot as measured"),
                         tr("The robot is shown where it is measured: see the tab Devices"));
  } else {
    playback_->show_note({}, {});
  }
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (may_leave()) {
    save_layout(*this);
    QMainWindow::closeEvent(event);
  } else {
    event->ignore();
  }
}

void MainWindow::show_theme(Theme theme) {
  if (theme == current_theme()) {
    return;
  }
  apply_theme(*qApp, theme);
  actions_->dark->setChecked(theme == Theme::kDark);
  view_->set_colors(colors_of(theme).view);
  actions_->refresh_icons();
  view_actions_->refresh_icons();
  playback_->refresh_icons();
  editing_->tree().refresh_icons();
  editing_->refresh_icons();
  start_page_->refresh();
  glove_->refresh_icons();
}

}  // namespace handway::gui
