#include "app/main_window.h"

#include "app/features.h"
#include "app/file_commands.h"
#include "app/freed_memory.h"
#include "app/pane_keys.h"
#include "app/start/command_palette.h"
#include "app/start/help.h"
#include "app/start/shortcut_list.h"
#include "app/start/start_page.h"
#include "app/view_actions.h"
#include "handway/device/recordings/recording_contents.h"
#include "handway/geometric/formats/cloud_reader.h"
#include "handway/geometric/formats/depth_image.h"
#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "handway/planning/paths/path_file.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/typed_input.h"
#include "widgets/forms/wheel_guard.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/panels/floating_card.h"
#include "widgets/panels/log_panel.h"
#include "widgets/panels/playback_bar.h"
#include "widgets/panels/xacro_dialog.h"
#include "widgets/style/text_rules.h"
#include "widgets/style/theme.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QMimeData>
#include <QStackedWidget>
#include <QStatusBar>
#include <QStringList>
#include <QUrl>

namespace handway::gui {

MainWindow::MainWindow(std::shared_ptr<planning::PluginManager> plugins, QWidget* parent)
    : QMainWindow(parent),
      middle_(new QStackedWidget),
      workbench_(std::move(plugins), *this, *middle_),
      start_page_(new StartPage),
      files_(new FileCommands(workbench_)) {
  setWindowTitle(tr("Handway"));
  setAcceptDrops(true);
  setContextMenuPolicy(Qt::NoContextMenu);
  new WheelGuard(this);
  new TypingGuard(this);
  new TextRules(this);
  new EnterKey(*this, workbench_.view);
  new FreedMemory(workbench_);
  new PaneKeys(*this, workbench_.view, workbench_.playback_bar);
  build_middle();
  add_commands();
  add_features(workbench_);
  workbench_.ask_before_leaving([this] { return files_->may_discard(); });
  workbench_.build();
  default_layout_ = saveState();
  restore_layout(*this);
  workbench_.view.set_colors(colors_of(current_theme()).view);
  auto* effects = new PreferenceEffects(workbench_);
  connect(effects, &PreferenceEffects::theme_changed, this, &MainWindow::show_theme);
  connect_document();
  show_scene();
  log_refused_plugins();
}

// Ends edits of focused fields while what they change still exists.
MainWindow::~MainWindow() { hide(); }

void MainWindow::build_middle() {
  PlaybackBar& bar = workbench_.playback_bar;
  bar.setProperty("role", "playback");
  middle_->addWidget(start_page_);
  middle_->addWidget(boxed(in_column({{&workbench_.view, 1}, &bar}, 0)));
  setCentralWidget(middle_);
  workbench_.add_dock(DockArea::kLeft, 2, {"messages", tr("Messages"), &workbench_.log, 110});
  statusBar()->addPermanentWidget(new FrameRateLabel(workbench_.view));
  connect(start_page_, &StartPage::open_requested, this, &MainWindow::open);
  connect(start_page_, &StartPage::try_requested, this, [this](const QString& file) {
    plays_next_ = true;
    open(file);
  });
  connect(start_page_, &StartPage::browse_requested, files_, &FileCommands::open);
  connect(start_page_, &StartPage::new_requested, this, &MainWindow::create);
  connect(start_page_, &StartPage::choice_requested, files_, &FileCommands::choose_new);
  connect(&workbench_, &Workbench::theme_changed, start_page_, &StartPage::refresh);
  connect(&workbench_, &Workbench::theme_changed, &bar, &PlaybackBar::refresh_icons);
  connect(&bar, &PlaybackBar::slowed_down, this,
          [this](const QString& message) { workbench_.log.add(LogPanel::Level::kNote, message); });
}

void MainWindow::add_commands() {
  auto& bodies = workbench_.own<BodyDisplayTool>(workbench_.document, workbench_.view);
  new ViewActions(workbench_, bodies);
  add_theme_command();
  auto* palette = new CommandPalette(*this);
  QAction* find = workbench_.make_action("", tr("Find a &command…"),
                                         QKeySequence(QStringLiteral("Ctrl+Shift+P")),
                                         tr("Find a command by letters of its name"));
  QAction* help = workbench_.make_action("", tr("Help on this &panel"), QKeySequence::HelpContents,
                                         tr("Help on the panel under the pointer"));
  QAction* about = workbench_.make_action("", tr("&About Handway"), {}, {});
  QAction* layout = workbench_.make_action("", tr("&Reset the layout"), {},
                                           tr("Put all panels back to their places"));
  workbench_.add_to_menu(MainMenu::kView, {3, 0}, layout);
  workbench_.add_to_menu(MainMenu::kHelp, {0, 0}, help);
  workbench_.add_to_menu(MainMenu::kHelp, {0, 1}, find);
  QAction* keys = workbench_.make_action("", tr("&Keyboard shortcuts"), {}, {});
  keys->setObjectName(QStringLiteral("help_shortcuts"));
  workbench_.add_to_menu(MainMenu::kHelp, {0, 2}, keys);
  workbench_.add_to_menu(MainMenu::kHelp, {0, 3}, about);
  connect(keys, &QAction::triggered, this, [this] { show_shortcuts(*this); });
  connect(find, &QAction::triggered, palette, &CommandPalette::ask);
  connect(help, &QAction::triggered, this, [this] { show_panel_help(*this); });
  connect(about, &QAction::triggered, this, [this] { show_about(*this); });
  connect(layout, &QAction::triggered, this, [this] {
    layout_with_scene_.reset();
    restoreState(default_layout_);
  });
}

void MainWindow::add_theme_command() {
  dark_ = workbench_.make_action("theme", tr("&Dark theme"), {}, tr("Light or dark colours"));
  dark_->setCheckable(true);
  dark_->setChecked(current_theme() == Theme::kDark);
  workbench_.add_to_bar(MainBar::kTools, {3, 15}, dark_);
  connect(dark_, &QAction::triggered, this, [this](bool dark) {
    show_theme(dark ? Theme::kDark : Theme::kLight);
    workbench_.preferences.set(&PreferenceValues::theme, std::optional(current_theme()));
  });
}

void MainWindow::connect_document() {
  const Document& document = workbench_.document;
  connect(&document, &Document::opening, this, [this](const QString& file) {
    statusBar()->showMessage(tr("Opening %1…").arg(QFileInfo(file).fileName()));
  });
  connect(&document, &Document::opened, this, [this](Document::Opened what) {
    if (what == Document::Opened::kRobots) {
      workbench_.view.change_robots(workbench_.document.scene());
      emit workbench_.scene_shown();
      return;
    }
    if (!workbench_.document.scene()) {
      workbench_.banner.hide_message();
      setWindowTitle(tr("Handway"));
      start_page_->refresh();
    }
    show_scene();
  });
  connect(&document, &Document::open_failed, this, [this](const QString& message) {
    statusBar()->clearMessage();
    workbench_.show_error(tr("The scene can't be opened"), message);
    emit failed(message);
  });
  connect(&document, &Document::measured_shown, this, &MainWindow::show_validity);
  connect(&workbench_.validity, &PathValidity::changed, this, &MainWindow::show_validity);
  connect(&workbench_.editor, &SceneEditor::modified_changed, this, &QWidget::setWindowModified);
  connect(files_, &FileCommands::saved, this, &MainWindow::update_title);
  connect(&workbench_, &Workbench::failed, this, &MainWindow::failed);
  const auto play_if_wanted = [this] {
    if (std::exchange(plays_next_, false) || workbench_.options.play) {
      workbench_.playback_bar.play();
    }
  };
  connect(&workbench_.session, &PlanningSession::path_opened, this, play_if_wanted);
  connect(&workbench_.session, &PlanningSession::ended, this, [play_if_wanted](bool solved) {
    if (solved) {
      play_if_wanted();
    }
  });
}

void MainWindow::log_refused_plugins() {
  for (const planning::RefusedPlugin& plugin : workbench_.plugins->refused()) {
    workbench_.log.add(LogPanel::Level::kWarning,
                       tr("Plugin %1 was not loaded: %2")
                           .arg(QString::fromStdString(plugin.file.filename().string()),
                                QString::fromStdString(plugin.reason)));
  }
}

void MainWindow::begin(const Options& options) {
  workbench_.options = options;
  emit workbench_.begun();
  if (!options.scene.empty()) {
    if (!options.screenshot.empty() || !options.xacro.empty()) {
      workbench_.document.open(options.scene, options.xacro);
    } else {
      with_xacro_arguments(this, options.scene,
                           [this, options](const geometric::XacroArguments& arguments) {
                             workbench_.document.open(options.scene, arguments);
                           });
    }
  } else {
    emit ready();
  }
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls() && event->mimeData()->urls().front().isLocalFile()) {
    event->acceptProposedAction();
  }
}

namespace {

// Returns whether a file is a recording of a hand. A table with a joint of the robot is a path of
// the robot.
bool is_hand_recording(const std::filesystem::path& file, const geometric::RobotInstance* robot) {
  try {
    if (!geometric::has_extension(file, ".csv")) {
      return device::is_recording(file);
    }
    const std::string head = geometric::head_of(file);
    bool names_joint = false;
    for (int v = 0; robot && v < robot->model->variable_count() && !names_joint; ++v) {
      names_joint = head.find(robot->model->variable(v).name) != std::string::npos;
    }
    return !names_joint;
  } catch (const geometric::InputError&) {
    return false;  // what opens it says why it can't be read
  }
}

QStringList files_of(const QMimeData& data) {
  QStringList files;
  for (const QUrl& url : data.urls()) {
    files << url.toLocalFile();
  }
  return files;
}

}  // namespace

void MainWindow::dropEvent(QDropEvent* event) {
  const QStringList files = files_of(*event->mimeData());
  const QString& file = files.front();
  const std::filesystem::path path = file.toStdString();
  const bool has_scene = workbench_.document.scene() != nullptr;
  // A PLY file of points is no mesh.
  if (has_scene && (geometric::is_cloud_file(path) || geometric::is_image_file(path))) {
    emit workbench_.cloud_dropped(file);
  } else if (has_scene && geometric::is_mesh_file(path)) {
    emit workbench_.mesh_dropped(file);
  } else if (has_scene && is_hand_recording(path, workbench_.document.robot())) {
    emit workbench_.recordings_dropped(files);
  } else if (has_scene && planning::is_path_file(path)) {
    emit workbench_.path_dropped(file);
  } else {
    open(file);
  }
}

void MainWindow::show_scene() {
  statusBar()->clearMessage();
  const auto& scene = workbench_.document.scene();
  workbench_.view.set_scene(scene);
  emit workbench_.scene_shown();
  files_->show_scene();
  if (!scene) {
    plays_next_ = false;
    middle_->setCurrentIndex(0);
    show_panels(false);
    return;
  }
  // The first appearance of the panels, and of the view, takes a while: each has an event of its
  // own.
  const auto in_its_own_event = [this](const auto& show) {
    QMetaObject::invokeMethod(
        this,
        [this, show] {
          if (workbench_.document.scene()) {
            show();
          }
        },
        Qt::QueuedConnection);
  };
  in_its_own_event([this] { show_panels(true); });
  in_its_own_event([this] { middle_->setCurrentIndex(1); });
  workbench_.banner.hide_message();
  update_title();
  workbench_.log.add(LogPanel::Level::kNote, tr("Opened %1").arg(workbench_.scene_name()));
  for (const std::string& warning : scene->warnings) {
    workbench_.log.add(LogPanel::Level::kWarning, QString::fromStdString(warning));
  }
  // The planner's form takes as long to build as all else: events in between are not kept waiting.
  QMetaObject::invokeMethod(
      this, [this, opening = ++openings_] { set_up_planning(opening); }, Qt::QueuedConnection);
}

// An empty window has nothing to show in its panels.
void MainWindow::show_panels(bool shown) {
  if (shown && layout_with_scene_) {
    restoreState(*layout_with_scene_);
    layout()->activate();  // the view then has its size from the beginning
    layout_with_scene_.reset();
  } else if (!shown && !layout_with_scene_) {
    layout_with_scene_ = saveState();
    for (QDockWidget* dock : findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
      dock->hide();
    }
  }
}

void MainWindow::set_up_planning(int opening) {
  if (opening != openings_ || !workbench_.document.scene()) {
    return;  // another scene has been opened or this one closed
  }
  try {
    apply_plan_options();
  } catch (const std::exception& error) {
    const QString message = QString::fromUtf8(error.what());
    workbench_.show_error(tr("The planner can't be set up"), message);
    emit failed(message);
    return;
  }
  if (plays_next_ || (workbench_.options.play && workbench_.options.path.empty())) {
    workbench_.session.start();
  }
  emit workbench_.ready();
  emit ready();
}

void MainWindow::update_title() {
  setWindowTitle(tr("%1[*] – Handway").arg(workbench_.scene_name()));
}

// Planning options of the command line override those of the scene.
void MainWindow::apply_plan_options() {
  const Options& options = workbench_.options;
  PlanSettings& settings = workbench_.plan_settings;
  settings.begin_scene();
  settings.apply(workbench_.document.scene()->planner);
  if (!options.planner.empty()) {
    settings.choose_planner(options.planner);
  }
  if (options.seed) {
    settings.set_seed(*options.seed);
    settings.set_seeds(1);
  }
  for (const auto& [key, value] : options.settings) {
    settings.set_parameter(key, value);
  }
}

QString MainWindow::message() const {
  return workbench_.banner.isVisible() ? workbench_.banner.message() : QString();
}

void MainWindow::show_validity() {
  const QString& reason = workbench_.validity.reason();
  if (workbench_.validity.state() == PathValidity::State::kInvalid &&
      workbench_.player.is_playing()) {
    workbench_.player.pause();
    workbench_.show_error(tr("The path is no longer valid"), reason);
  }
  PlaybackBar& bar = workbench_.playback_bar;
  if (!reason.isEmpty()) {
    bar.show_note(workbench_.validity.state() == PathValidity::State::kInvalid ? tr("not valid")
                                                                               : tr("out of date"),
                  reason);
  } else if (workbench_.document.shows_measured()) {
    bar.show_note(tr("robot as measured"),
                  tr("The robot is shown at its measured joint positions: see the tab Devices"));
  } else {
    bar.show_note({}, {});
  }
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (workbench_.may_leave()) {
    show_panels(true);  // as they are kept
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
  dark_->setChecked(theme == Theme::kDark);
  workbench_.view.set_colors(colors_of(theme).view);
  emit workbench_.theme_changed();
}

}  // namespace handway::gui
