#pragma once

#include "features/editing/arrange_actions.h"
#include "features/editing/edit_actions.h"
#include "features/editing/resize_tool.h"
#include "model/document/collision_monitor.h"
#include "model/document/scene_editor.h"

#include <QObject>

namespace handway::gui {

class PropertiesPanel;
class SceneTree;
class SceneView;
class WindowActions;

/// Keeps view, tree, properties and menus in step with what is selected and edited.
class SceneEditing : public QObject {
  Q_OBJECT

 public:
  /// All outlive it.
  SceneEditing(QMainWindow& window, WindowActions& actions, Document& document, SceneView& view,
               SceneTree& tree, CollisionMonitor& collisions);

  [[nodiscard]] SceneEditor& editor() { return editor_; }
  [[nodiscard]] EditActions& actions() { return edit_actions_; }
  [[nodiscard]] ArrangeActions& arrange() { return arrange_actions_; }
  [[nodiscard]] ResizeTool& resize() { return resize_; }
  /// To be put into a dock.
  [[nodiscard]] PropertiesPanel* properties() const { return properties_; }
  void refresh_icons();

  /// Adds a mesh from a file. Where that fails, failed() tells.
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
  Document& document_;
  SceneView& view_;
  SceneTree& tree_;
  SceneEditor editor_;
  EditActions edit_actions_;
  ArrangeActions arrange_actions_;
  ResizeTool resize_;
  PropertiesPanel* properties_;
  CollisionReport report_;
  bool has_handles_ = true;
};

}  // namespace handway::gui
