#pragma once

#include "handway/planning/extensions/plugin.h"
#include "model/devices/contact_guard.h"
#include "model/devices/motion_driver.h"
#include "model/document/collision_monitor.h"
#include "model/document/document.h"
#include "model/document/scene_editor.h"
#include "model/planning/motion_source.h"
#include "model/planning/path_history.h"
#include "model/planning/path_validity.h"
#include "model/planning/plan_settings.h"
#include "model/planning/planning_session.h"
#include "model/playback/motion_analysis.h"
#include "model/playback/path_player.h"
#include "model/settings/options.h"
#include "model/settings/preferences.h"
#include "view3d/film.h"
#include "widgets/panels/dock_layout.h"

#include <QAction>
#include <QObject>
#include <QString>

#include <compare>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

class QMainWindow;
class QMenu;
class QToolBar;
class QWidget;

namespace handway::gui {

class Banner;
class LogPanel;
class PlaybackBar;
class SceneView;

/// kContext: what a click with the right button offers, of commands that are in other menus too.
enum class MainMenu { kFile, kEdit, kAdd, kPlan, kView, kHelp, kContext };
enum class MainBar { kTools, kEditing };
enum class DockArea { kLeft, kHistory, kControl, kBelow };

/// Position in a menu or tool bar, independent of the order in which entries are added: sections
/// are divided by separators.
struct Position {
  int section = 0;
  int order = 0;  ///< In the section.

  auto operator<=>(const Position&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// Interface between the window and its features: the model, the 3-D view, and places for their
/// menus, tool bar buttons and docks. A feature is a folder with a function `add_NAME(Workbench&)`;
/// common parts of features are here, so that no feature knows another.
class Workbench : public QObject {
  Q_OBJECT

 public:
  /// @param centre in the middle of the window: the banner floats over it.
  Workbench(std::shared_ptr<planning::PluginManager> loaded_plugins, QMainWindow& main_window,
            QWidget& centre);
  ~Workbench() override;

  std::shared_ptr<planning::PluginManager> plugins;
  Options options;  ///< For the open scene; empty once another is opened.
  Preferences preferences;
  Document document;
  SceneEditor editor;
  PathPlayer player;
  Posing posing;
  PlanSettings plan_settings;
  CollisionMonitor collisions;  ///< Collisions of the shown posture.
  PlanningSession session;
  PathValidity validity;  ///< Validity of the played path in the present scene.
  MotionAnalysis analysis;
  PathHistory history;
  ContactGuard guard;  ///< Checks the postures that external sources propose for the robot.
  MotionDriver driver;

  QMainWindow& window;
  SceneView& view;
  Banner& banner;  ///< Above the view.
  PlaybackBar& playback_bar;
  LogPanel& log;

  /// Makes an object that lives as long as the feature does.
  template <typename Tool, typename... Arguments>
  Tool& own(Arguments&&... arguments) {
    auto tool = std::make_unique<Tool>(std::forward<Arguments>(arguments)...);
    Tool& made = *tool;
    made.setParent(this);
    tools_.push_back(std::move(tool));
    return made;
  }

  /// A command of the window. @param name of the object and of its icon, which follows the theme;
  /// may be empty. @param tip empty: none.
  [[nodiscard]] QAction* make_action(const QString& name, const QString& text,
                                     const QKeySequence& keys, const QString& tip);
  /// The icon of `action`, by its object name, follows the theme.
  void keep_icon(QAction& action);
  /// Adds an action. Has no effect after build(), like the next three functions. Submenus are added
  /// by their menuAction().
  void add_to_menu(MainMenu menu, Position position, QAction* action);
  /// @param with_text beside the icon.
  void add_to_bar(MainBar bar, Position position, QAction* action, bool with_text = false);
  void add_to_bar(MainBar bar, Position position, QWidget* widget);
  /// @param order among the docks of the area.
  void add_dock(DockArea area, int order, const DockContent& content);
  /// Adds a page to a panel of the control tabs that has pages; without that panel it is a tab.
  void add_page(const char* panel, const QString& title, QWidget* page);
  /// Pops up what of MainMenu::kContext can be done now. @param place on the screen.
  void show_context_menu(const QPoint& place);
  /// Returns a menu. @pre menu is not kContext.
  [[nodiscard]] QMenu& menu(MainMenu menu) const { return *menus_.at(menu); }
  /// Puts everything that was added in its place. Call this once.
  void build();

  /// Shows the dock or tab of that name, if there is one.
  void show_panel(const char* name) const;
  /// Triggers the command with that object name, if there is one.
  void trigger(const char* action) const;

  /// Returns the displayed name of the open scene.
  [[nodiscard]] QString scene_name() const;
  /// Opens a file unless something keeps the scene from being left. Asks for the arguments of a
  /// robot file in xacro.
  void open(const std::filesystem::path& file, const Options& with = {});
  /// Begins a new scene with a robot of the library and a hand on it unless something keeps the
  /// scene from being left. @param hand empty: none.
  void create(const std::string& robot, const std::string& hand);
  /// Shows the start page unless something keeps the scene from being left.
  void close();
  /// @param may_leave asked before the scene or the program is left; returns false to stay.
  void ask_before_leaving(std::function<bool()> may_leave);
  [[nodiscard]] bool may_leave() const;

  /// @param busy whether the window does not show yet what was asked for.
  void add_work(std::function<bool()> busy);
  [[nodiscard]] bool is_busy() const;
  /// @param time for how long a device has been listened to, s; nothing: none is connected.
  void add_stream(std::function<std::optional<double>()> time);
  /// The longest of all streams.
  [[nodiscard]] std::optional<double> listening_time() const;

  /// Writes an error into the log, and into the banner above the view.
  void show_error(const QString& title, const QString& message);

 signals:
  /// The window is on screen, its options are known.
  void begun();
  /// Emitted when another scene is shown, or none.
  void scene_shown();
  /// The scene is shown and the planner is set up.
  void ready();
  /// The scene, or what the options ask of it, is not to be had.
  void failed(const QString& message);
  /// A file of a mesh was dropped on the window.
  void mesh_dropped(const QString& file);
  /// A file of points or a depth image was.
  void cloud_dropped(const QString& file);
  /// A file of a path was.
  void path_dropped(const QString& file);
  /// Recordings of a hand were.
  void recordings_dropped(const QStringList& files);
  /// A motion other than the played path is to be exported.
  void export_wanted(const handway::gui::DerivedSource& source);
  /// Pictures or a video of a film other than the played path are to be written.
  void pictures_wanted(const handway::gui::Film& film);
  /// A planned task is to run on the robot, and not any more.
  void run_wanted(const handway::gui::DerivedSource& task);
  void task_forgotten();
  /// Emitted when there is room in the view for the handles of the selection, or no more.
  void handles_welcome(bool welcome);
  void theme_changed();

 private:
  struct Entry {
    Position position;
    std::variant<QAction*, QWidget*> content;
    bool with_text = false;
  };
  struct Page {
    const char* panel;
    QString title;
    QWidget* widget;
  };

  void follow_document();
  /// Adds the played path to the history, with its figures.
  void remember_path();
  [[nodiscard]] std::vector<DockContent> docks_of(DockArea area) const;
  void build_pages();
  static void fill(QMenu& menu, const std::vector<Entry>& entries);
  void build_menus();
  void build_bars();

  std::map<MainMenu, QMenu*> menus_;
  std::map<MainMenu, std::vector<Entry>> menu_entries_;
  std::map<MainBar, std::vector<Entry>> bar_entries_;
  std::map<DockArea, std::multimap<int, DockContent>> docks_;
  std::vector<Page> pages_;
  std::vector<QAction*> with_icon_;
  std::vector<std::function<bool()>> leave_guards_;
  std::vector<std::function<bool()>> works_;
  std::vector<std::function<std::optional<double>()>> streams_;
  std::vector<std::unique_ptr<QObject>> tools_;  ///< Work with all the others: gone first.
};

}  // namespace handway::gui
