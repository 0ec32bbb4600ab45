#pragma once

#include "features/workbench.h"

#include <QMainWindow>

#include <memory>
#include <optional>

class QStackedWidget;

namespace handway::gui {

class FileCommands;
class StartPage;

/// The workbench's window: its features around the 3-D view, or a page to start from.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  explicit MainWindow(std::shared_ptr<planning::PluginManager> plugins, QWidget* parent = nullptr);
  ~MainWindow() override;

  /// Opens the options' scene and sets the planner as they say.
  void begin(const Options& options);
  void open(const QString& file) { workbench_.open(file.toStdString()); }
  /// Begins a new scene with a robot of the library.
  void create(const std::string& robot) { workbench_.create(robot, {}); }

  [[nodiscard]] Workbench& workbench() { return workbench_; }
  [[nodiscard]] Document& document() { return workbench_.document; }
  [[nodiscard]] PlanningSession& session() { return workbench_.session; }
  [[nodiscard]] SceneEditor& editor() { return workbench_.editor; }
  [[nodiscard]] PathPlayer& player() { return workbench_.player; }
  [[nodiscard]] SceneView& view() { return workbench_.view; }
  /// The message in the window; empty if there is none.
  [[nodiscard]] QString message() const;

 signals:
  /// The scene is shown, and planning has begun if the options say so.
  void ready();
  /// The scene, or what the options ask of it, is not to be had.
  void failed(const QString& message);

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  /// Asks for confirmation if a robot moves, and if there are unsaved changes.
  void closeEvent(QCloseEvent* event) override;

 private:
  void build_middle();
  void add_commands();
  void add_theme_command();
  void connect_document();
  void show_scene();
  /// Sets planner and options for the scene that was opened, and emits ready() or failed().
  /// @param opening number of that opening; an older one has no effect.
  void show_panels(bool shown);
  void set_up_planning(int opening);
  void apply_plan_options();
  void show_validity();
  void update_title();
  void show_theme(Theme theme);
  void log_refused_plugins();

  QStackedWidget* middle_;
  int openings_ = 0;  ///< Number of scenes that were opened.
  Workbench workbench_;
  StartPage* start_page_;
  FileCommands* files_;
  QAction* dark_;
  QByteArray default_layout_;
  /// State of the panels while they are hidden because no scene is open.
  std::optional<QByteArray> layout_with_scene_;
  bool plays_next_ = false;  ///< The scene that is being opened is to be planned and played.
};

}  // namespace handway::gui
