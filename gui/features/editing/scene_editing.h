#pragma once

#include "features/editing/edit_actions.h"
#include "features/editing/resize_tool.h"
#include "model/document/collision_monitor.h"
#include "model/document/scene_editor.h"

#include <QObject>

class QMainWindow;
class QMenu;
class QToolBar;

namespace handway::gui {

class Document;
class PropertiesPanel;
class SceneTree;
class SceneView;

/// What SceneEditing works with; all outlive it.
struct EditingParts {
  QMainWindow& window;
  QMenu& edit_menu;
  QMenu& add_menu;
  QToolBar& bar;
  SceneEditor& editor;
  SceneView& view;
  CollisionMonitor& collisions;
};

/// Keeps view, tree, properties and menus in step with what is selected and edited.
class SceneEditing : public QObject {
  Q_OBJECT

 public:
  explicit SceneEditing(const EditingParts& parts);

  [[nodiscard]] EditActions& actions() { return edit_actions_; }
  [[nodiscard]] ArrangeActions& arrange() { return arrange_actions_; }
  [[nodiscard]] ResizeTool& resize() { return resize_; }
  /// To be put into docks.
  [[nodiscard]] SceneTree& tree() const { return *tree_; }
  [[nodiscard]] PropertiesPanel* properties() const { return properties_; }
  void refresh_icons();

  /// Adds a mesh from a file. Where that fails, failed() says so.
  void add_mesh(const QString& file);
  /// Whether what is selected has handles to be moved by, where it can be moved.
  void show_handles(bool shown);

 signals:
  /// The scene as it would be if what is dragged stayed where it is now.
  void tried(const handway::gui::SceneState& state);
  void failed(const QString& title, const QString& message);

 private:
  void connect_view();
  void show_selection();
  void show_edit(const SceneState& before);
  void update_gizmo();
  void preview(const SceneState& state);
  void attach(const std::string& robot, const std::string& link);

  QMainWindow& window_;
  const Document& document_;
  SceneView& view_;
  SceneEditor& editor_;
  EditActions edit_actions_;
  ArrangeActions arrange_actions_;
  ResizeTool resize_;
  SceneTree* tree_;
  PropertiesPanel* properties_;
  CollisionReport report_;
  bool has_handles_ = true;
};

/// Draws the scene's constraints into the view, for the posture on screen.
class ConstraintDisplay : public QObject {
  Q_OBJECT

 public:
  /// Both outlive it.
  ConstraintDisplay(Document& document, SceneView& view, QObject* parent = nullptr);

 private:
  void show();

  Document& document_;
  SceneView& view_;
};

}  // namespace handway::gui
