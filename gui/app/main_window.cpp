#include "app/main_window.h"

#include "app/recent_files.h"
#include "glove/glove_panel.h"
#include "handway/geometric/io/input_error.h"
#include "panels/banner.h"
#include "panels/collision_label.h"
#include "panels/joint_panel.h"
#include "panels/playback_bar.h"
#include "panels/pmd_panel.h"
#include "panels/posture_bar.h"
#include "panels/scene_tree.h"
#include "style/theme.h"
#include "view3d/scene_view.h"
#include "workers/palm_path.h"

#include <QApplication>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMessageBox>
#include <QMimeData>
#include <QSettings>
#include <QStatusBar>
#include <QTabBar>
#include <QTabWidget>
#include <QVBoxLayout>

namespace handway::gui {
namespace {

QDockWidget* make_dock(QMainWindow& window, const QString& title, QWidget* content,
                       Qt::DockWidgetArea area) {
  auto* dock = new QDockWidget(title, &window);
  dock->setObjectName(title);
  dock->setFeatures(QDockWidget::DockWidgetMovable | QDockWidget::DockWidgetClosable);
  dock->setWidget(content);
  window.addDockWidget(area, dock);
  return dock;
}

QWidget* stacked(std::initializer_list<QWidget*> parts, int stretched) {
  auto* box = new QWidget;
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  int index = 0;
  for (QWidget* part : parts) {
    layout->addWidget(part, index++ == stretched ? 1 : 0);
  }
  return box;
}

}  // namespace

MainWindow::MainWindow(std::shared_ptr<planning::Extensions> extensions, QWidget* parent)
    : QMainWindow(parent),
      extensions_(std::move(extensions)),
      document_(extensions_),
      view_(new SceneView),
      banner_(new Banner(view_)),
      tree_(new SceneTree),
      log_(new LogPanel),
      plan_panel_(new PlanPanel(extensions_->planners())),
      posture_bar_(new PostureBar),
      joint_panel_(new JointPanel),
      pmd_panel_(new PmdPanel),
      glove_panel_(new GlovePanel),
      playback_(new PlaybackBar(player_)),
      collision_label_(new CollisionLabel),
      actions_(std::make_unique<WindowActions>(*this)) {
  setWindowTitle(tr("Handway"));
  setAcceptDrops(true);
  build_docks();
  session_ = std::make_unique<PlanningSession>(document_, *plan_panel_, player_);
  view_->set_colors(colors_of(current_theme()).view);
  view_->set_empty_text(tr("Open a scene: File > Open, or drop a file here"));
  connect_actions();
  connect_document();
  connect_view();
  connect_planning();
  show_scene();
  for (const planning::RefusedPlugin& plugin : extensions_->refused()) {
    log_->add(LogPanel::Level::kWarning,
              tr("Plugin %1 was not taken: %2")
                  .arg(QString::fromStdString(plugin.file.filename().string()),
                       QString::fromStdString(plugin.reason)));
  }
}

MainWindow::~MainWindow() = default;

void MainWindow::build_docks() {
  playback_->setProperty("role", "playback");
  setCentralWidget(stacked({view_, playback_}, 0));
  auto* tabs = new QTabWidget;
  tabs->setDocumentMode(true);
  tabs->tabBar()->setDrawBase(false);
  tabs->tabBar()->setExpanding(true);
  tabs->addTab(plan_panel_, tr("Plan"));
  tabs->addTab(stacked({posture_bar_, joint_panel_}, 1), tr("Joints"));
  tabs->addTab(pmd_panel_, tr("Hand"));
  tabs->addTab(glove_panel_, tr("Glove"));
  QDockWidget* scene = make_dock(*this, tr("Scene"), tree_, Qt::LeftDockWidgetArea);
  QDockWidget* log = make_dock(*this, tr("Messages"), log_, Qt::LeftDockWidgetArea);
  QDockWidget* right = make_dock(*this, tr("Control"), tabs, Qt::RightDockWidgetArea);
  right->setTitleBarWidget(new QWidget);
  resizeDocks({scene, right}, {250, 340}, Qt::Horizontal);
  resizeDocks({scene, log}, {560, 190}, Qt::Vertical);
  for (QDockWidget* dock : {scene, log, right}) {
    actions_->view_menu()->addAction(dock->toggleViewAction());
  }
  statusBar()->addWidget(collision_label_, 1);
}

void MainWindow::connect_actions() {
  connect(actions_->open, &QAction::triggered, this, &MainWindow::choose_file);
  connect(actions_->recent, &RecentFiles::chosen, this, &MainWindow::open);
  connect(actions_->save_as, &QAction::triggered, this, &MainWindow::save_as);
  connect(actions_->picture, &QAction::triggered, this, &MainWindow::save_picture);
  connect(actions_->quit, &QAction::triggered, this, &QWidget::close);
  connect(actions_->fit, &QAction::triggered, view_, &SceneView::fit);
  const auto look = [this](QAction* action, StandardView direction) {
    connect(action, &QAction::triggered, view_, [this, direction] { view_->look_from(direction); });
  };
  look(actions_->oblique, StandardView::kOblique);
  look(actions_->front, StandardView::kFront);
  look(actions_->left, StandardView::kLeft);
  look(actions_->top, StandardView::kTop);
  connect(actions_->floor, &QAction::toggled, view_, &SceneView::set_floor_visible);
  connect(actions_->samples, &QAction::toggled, view_, &SceneView::set_dots_visible);
  actions_->dark->setChecked(current_theme() == Theme::kDark);
  connect(actions_->dark, &QAction::toggled, this, &MainWindow::toggle_theme);
  connect(actions_->about, &QAction::triggered, this, &MainWindow::show_about);
}

void MainWindow::connect_document() {
  connect(&document_, &Document::opening, this, [this](const QString& file) {
    statusBar()->showMessage(tr("Opening %1…").arg(QFileInfo(file).fileName()));
  });
  connect(&document_, &Document::opened, this, &MainWindow::show_scene);
  connect(&document_, &Document::open_failed, this, [this](const QString& message) {
    statusBar()->clearMessage();
    show_error(tr("The scene can't be opened"), message);
    emit failed(message);
  });
  connect(&document_, &Document::configuration_changed, this, [this](const Eigen::VectorXd& q) {
    view_->set_configuration(q);
    joint_panel_->set_configuration(q);
    pmd_panel_->set_configuration(q);
    glove_panel_->set_configuration(q);
    collisions_.check(q);
  });
  connect(&collisions_, &CollisionMonitor::checked, this, [this](const CollisionReport& report) {
    std::vector<std::string> bodies;
    for (const geometric::NamedPair& pair : report.collisions) {
      bodies.push_back(pair.a);
      bodies.push_back(pair.b);
    }
    view_->set_collisions(std::move(bodies));
    collision_label_->show_report(report);
  });
  connect(&collisions_, &CollisionMonitor::failed, this, [this](const QString& message) {
    collision_label_->show_nothing();
    log_->add(LogPanel::Level::kError, tr("Collisions are not checked: %1").arg(message));
  });
}

void MainWindow::connect_view() {
  connect(view_, &SceneView::picked, this, [this](const SceneItem& item) {
    tree_->select(item);
    view_->set_selection(item);
  });
  connect(tree_, &SceneTree::item_selected, view_, &SceneView::set_selection);
  connect(tree_, &SceneTree::ghosts_toggled, view_, &SceneView::show_ghosts);
  connect(tree_, &SceneTree::posture_activated, this, [this](const SceneItem& item) {
    const auto& q =
        item.kind == SceneItem::Kind::kStart ? document_.scene()->start : document_.scene()->goal;
    player_.pause();
    document_.set_configuration(*q);
  });
  const auto edit = [this](const Eigen::VectorXd& q) {
    player_.pause();
    document_.set_configuration(q);
  };
  connect(joint_panel_, &JointPanel::configuration_edited, this, edit);
  connect(pmd_panel_, &PmdPanel::configuration_edited, this, edit);
  connect(glove_panel_, &GlovePanel::posture_changed, this,
          [this](const geometric::NamedPosture& posture) {
            player_.pause();
            document_.apply_posture(posture);
          });
  connect(view_, &SceneView::frameSwapped, glove_panel_, &GlovePanel::note_drawn);
  connect(posture_bar_, &PostureBar::start_requested, this,
          [this, edit] { edit(*document_.scene()->start); });
  connect(posture_bar_, &PostureBar::goal_requested, this,
          [this, edit] { edit(*document_.scene()->goal); });
  connect(posture_bar_, &PostureBar::posture_requested, this,
          [this](const geometric::NamedPosture& posture) {
            player_.pause();
            document_.apply_posture(posture);
          });
}

void MainWindow::connect_planning() {
  connect(actions_->plan, &QAction::triggered, session_.get(), &PlanningSession::start);
  connect(actions_->cancel, &QAction::triggered, session_.get(), &PlanningSession::cancel);
  connect(session_.get(), &PlanningSession::started, this, [this] {
    actions_->plan->setEnabled(false);
    actions_->cancel->setEnabled(true);
    log_->add(LogPanel::Level::kNote,
              tr("Planning with %1, seed %2")
                  .arg(QString::fromStdString(plan_panel_->planner()->name()))
                  .arg(plan_panel_->request().seed));
  });
  connect(session_.get(), &PlanningSession::nodes_changed, view_,
          [this](const std::vector<Eigen::Vector3d>& palms) { view_->set_dots(palms); });
  connect(session_.get(), &PlanningSession::path_changed, this, &MainWindow::show_path);
  connect(session_.get(), &PlanningSession::ended, this, [this](bool solved, const QString& text) {
    actions_->plan->setEnabled(true);
    actions_->cancel->setEnabled(false);
    log_->add(solved ? LogPanel::Level::kNote : LogPanel::Level::kWarning, text);
    if (solved && options_.play) {
      player_.play();
    }
  });
}

void MainWindow::begin(const Options& options) {
  options_ = options;
  if (!options.scene.empty()) {
    document_.open(options.scene);
  } else {
    emit ready();
  }
}

void MainWindow::open(const QString& file) {
  options_ = {};
  document_.open(file.toStdString());
}

void MainWindow::show_scene() {
  statusBar()->clearMessage();
  const auto& scene = document_.scene();
  collisions_.set_problem(document_.problem());
  collision_label_->show_nothing();
  view_->set_scene(scene);
  tree_->set_scene(scene);
  posture_bar_->set_scene(scene);
  const geometric::RobotInstance* robot = document_.robot();
  joint_panel_->set_robot(robot ? robot->model : nullptr, document_.groups());
  glove_panel_->set_hand(robot ? robot->model : nullptr, document_.loaded().basis,
                         document_.problem());
  pmd_panel_->set_hand(robot ? robot->model : nullptr, document_.loaded().basis,
                       document_.groups().hand);
  const bool has_query = scene && scene->start && scene->goal;
  plan_panel_->set_ready(
      has_query, scene ? tr("The scene has no start or no goal") : tr("Open a scene first"));
  actions_->plan->setEnabled(has_query);
  actions_->save_as->setEnabled(scene != nullptr);
  if (!scene) {
    return;
  }
  banner_->hide();
  const QString name = QString::fromStdString(
      scene->name.empty() ? document_.file().filename().string() : scene->name);
  setWindowTitle(tr("%1 – Handway").arg(name));
  log_->add(LogPanel::Level::kNote, tr("Opened %1").arg(name));
  for (const std::string& warning : scene->warnings) {
    log_->add(LogPanel::Level::kWarning, QString::fromStdString(warning));
  }
  if (!document_.file().empty()) {
    actions_->recent->add(QString::fromStdString(document_.file().string()));
  }
  try {
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

void MainWindow::apply_plan_options() {
  plan_panel_->apply(document_.scene()->planner);
  if (!options_.planner.empty()) {
    plan_panel_->choose_planner(options_.planner);
  }
  if (options_.seed) {
    plan_panel_->set_seed(*options_.seed);
  }
  for (const auto& [key, value] : options_.settings) {
    plan_panel_->set_parameter(key, value);
  }
}

void MainWindow::apply_glove_options() {
  if (!options_.glove.empty() || !options_.glove_page.empty()) {
    glove_panel_->come_to_front(QString::fromStdString(options_.glove_page));
    glove_panel_->connect_to(QString::fromStdString(options_.glove));
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

void MainWindow::choose_file() {
  const QString file = QFileDialog::getOpenFileName(
      this, tr("Open a scene"), QFileInfo(QString::fromStdString(document_.file().string())).path(),
      tr("Scenes, problems and robots (*.yaml *.yml *.xml *.urdf);;All files (*)"));
  if (!file.isEmpty()) {
    open(file);
  }
}

void MainWindow::save_as() {
  QString file = QFileDialog::getSaveFileName(
      this, tr("Save the scene"),
      QString::fromStdString(document_.file().stem().string() + ".yaml"), tr("Scenes (*.yaml)"));
  if (file.isEmpty()) {
    return;
  }
  if (QFileInfo(file).suffix().isEmpty()) {
    file += QStringLiteral(".yaml");
  }
  try {
    document_.save(file.toStdString(), plan_panel_->choice());
  } catch (const std::exception& error) {
    show_error(tr("The scene was not saved"), QString::fromUtf8(error.what()));
    return;
  }
  actions_->recent->add(file);
  log_->add(LogPanel::Level::kNote, tr("Saved as %1").arg(file));
}

void MainWindow::save_picture() {
  const QString file =
      QFileDialog::getSaveFileName(this, tr("Save a picture"), {}, tr("Pictures (*.png)"));
  if (!file.isEmpty() && !view_->grab().save(file)) {
    show_error(tr("The picture was not saved"), tr("%1 can't be written").arg(file));
  }
}

void MainWindow::toggle_theme(bool dark) {
  const Theme theme = dark ? Theme::kDark : Theme::kLight;
  apply_theme(*qApp, theme);
  QSettings().setValue(QStringLiteral("theme"), dark ? "dark" : "light");
  view_->set_colors(colors_of(theme).view);
  actions_->refresh_icons();
  playback_->refresh_icons();
  tree_->refresh_icons();
  glove_panel_->refresh_icons();
}

void MainWindow::show_about() {
  auto* box = new QMessageBox(QMessageBox::NoIcon, tr("About Handway"),
                              tr("<h3>Handway %1</h3><p>Simulator and planning workbench for "
                                 "hand-arm robots.</p>")
                                  .arg(QApplication::applicationVersion()),
                              QMessageBox::Close, this);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->open();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls() && event->mimeData()->urls().front().isLocalFile()) {
    event->acceptProposedAction();
  }
}

void MainWindow::dropEvent(QDropEvent* event) {
  open(event->mimeData()->urls().front().toLocalFile());
}

}  // namespace handway::gui
