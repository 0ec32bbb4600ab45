#pragma once

#include "app/log_panel.h"
#include "app/options.h"
#include "app/window_actions.h"
#include "model/document/document.h"
#include "model/document/scene_editor.h"
#include "model/planning/planning_session.h"
#include "model/playback/path_player.h"
#include "model/playback/posing.h"
#include "model/settings/preferences.h"

#include <QMainWindow>

#include <memory>

class QStackedWidget;

namespace handway::gui {

class Banner;
class BodyDisplayTool;
class CampaignsPanel;
class CollisionDisplay;
class CollisionMonitor;
class CommandPalette;
class DeviceSession;
class FileCommands;
class GlovePanel;
class GraspTool;
class PalmTool;
class PathValidity;
class PlanPanel;
class PlaybackBar;
class PlaybackTools;
class PlanningCommands;
class PlanningViews;
class PosturePanels;
class PreferenceEffects;
class QueryCheck;
class Recovery;
class RunsTool;
class SceneEditing;
class SceneView;
class StartPage;
class ViewActions;
class WristPage;

/// The workbench's window. Builds the parts and connects them; what they do is theirs.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  explicit MainWindow(std::shared_ptr<planning::Extensions> extensions, QWidget* parent = nullptr);
  ~MainWindow() override;

  /// Opens the options' scene and sets the planner as they say.
  void begin(const Options& options);
  void open(const QString& file);
  /// Begins a new scene with a robot of the library.
  void create(const std::string& robot);

  [[nodiscard]] Preferences& preferences() { return preferences_; }
  [[nodiscard]] BodyDisplayTool& body_display() { return *body_display_; }
  [[nodiscard]] Document& document() { return document_; }
  [[nodiscard]] PlanningSession& session() { return *session_; }
  [[nodiscard]] SceneEditor& editor() { return editor_; }
  [[nodiscard]] SceneEditing& editing() { return *editing_; }
  [[nodiscard]] Recovery& recovery() { return *recovery_; }
  [[nodiscard]] PathPlayer& player() { return player_; }
  [[nodiscard]] PlaybackTools& playback() { return *playback_tools_; }
  [[nodiscard]] SceneView& view() { return *view_; }
  [[nodiscard]] PlanSettings& plan_settings() { return plan_settings_; }
  [[nodiscard]] PlanPanel& plan_panel() { return *plan_panel_; }
  [[nodiscard]] GlovePanel& glove_panel() { return *glove_; }
  [[nodiscard]] WristPage& wrist_page() { return *wrist_; }
  [[nodiscard]] CampaignsPanel& campaigns() { return *campaigns_; }
  [[nodiscard]] DeviceSession& devices() { return *devices_; }
  [[nodiscard]] const PathValidity& path_validity() const { return *validity_; }
  [[nodiscard]] CollisionMonitor& collisions();
  [[nodiscard]] GraspTool& grasp_tool() { return *grasp_tool_; }
  [[nodiscard]] PlanningViews& planning_views() { return *planning_views_; }
  [[nodiscard]] QueryCheck& query_check() { return *query_check_; }
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
  /// Asks about a robot that moves, and about unsaved changes.
  void closeEvent(QCloseEvent* event) override;

 private:
  void build_docks();
  void connect_actions();
  void connect_document();
  void connect_start();
  void connect_view();
  void connect_glove();
  void connect_planning();
  void connect_devices();
  void connect_campaigns();
  /// Asks about a robot that moves, and about unsaved changes. @returns false to keep the scene.
  [[nodiscard]] bool may_leave();
  void export_path();
  void show_scene();
  void show_hand();
  void show_error(const QString& title, const QString& message);
  void apply_plan_options();
  void apply_glove_options();
  void show_path();
  void show_optimized(const planning::Path& path);
  void show_validity();
  void update_title();
  void update_ready();
  void show_theme(Theme theme);

  std::shared_ptr<planning::Extensions> extensions_;
  Options options_;
  Preferences preferences_;
  Document document_;
  SceneEditor editor_;
  PathPlayer player_;
  Posing posing_;
  PlanSettings plan_settings_;
  SceneView* view_;
  QStackedWidget* middle_;
  Banner* banner_;
  LogPanel* log_;
  PlanPanel* plan_panel_;
  CampaignsPanel* campaigns_;
  std::unique_ptr<PosturePanels> postures_;
  GlovePanel* glove_;
  WristPage* wrist_;
  std::unique_ptr<DeviceSession> devices_;
  std::unique_ptr<CollisionDisplay> collisions_;
  std::unique_ptr<PlanningViews> planning_views_;
  PlaybackBar* playback_;
  StartPage* start_page_;
  CommandPalette* palette_;
  QByteArray default_layout_;
  std::unique_ptr<WindowActions> actions_;
  std::unique_ptr<BodyDisplayTool> body_display_;
  std::unique_ptr<ViewActions> view_actions_;
  std::unique_ptr<PlaybackTools> playback_tools_;
  std::unique_ptr<SceneEditing> editing_;
  std::unique_ptr<FileCommands> files_;
  std::unique_ptr<Recovery> recovery_;
  std::unique_ptr<PreferenceEffects> preference_effects_;
  std::unique_ptr<PlanningSession> session_;
  std::unique_ptr<PathValidity> validity_;
  std::unique_ptr<PlanningCommands> planning_commands_;
  std::unique_ptr<RunsTool> runs_tool_;
  std::unique_ptr<QueryCheck> query_check_;
  std::unique_ptr<PalmTool> palm_tool_;
  std::unique_ptr<GraspTool> grasp_tool_;
};

}  // namespace handway::gui
