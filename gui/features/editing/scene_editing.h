#pragma once

#include "features/editing/cloud_tool.h"
#include "features/editing/edit_actions.h"
#include "features/editing/resize_tool.h"
#include "model/document/autosave.h"
#include "model/document/collision_monitor.h"
#include "model/document/scene_editor.h"
#include "model/planning/plan_settings.h"

#include <QObject>

namespace handway::gui {

class Banner;
class Workbench;

/// Stores the scene after every edit, and offers what was lost before.
class Recovery : public QObject {
  Q_OBJECT

 public:
  /// @param workbench outlives it.
  explicit Recovery(Workbench& workbench);

  [[nodiscard]] Autosave& autosave() { return autosave_; }

 signals:
  /// Scenes can't be stored; reported once until one can again.
  void failed(const QString& message);

 private:
  /// Sets whether unsaved changes are kept. Switching this off removes those that are kept.
  void set_enabled(bool enabled);
  /// Offers in the banner what was lost last, if anything was.
  void offer();
  void recover(const LostScene& lost);
  void store(const std::optional<LostScene>& then_forget);

  Document& document_;
  SceneEditor& editor_;
  const PlanSettings& planning_;
  Banner& banner_;
  Autosave autosave_;
  std::optional<LostScene> recovering_;
  bool enabled_ = true;
  bool fails_ = false;
};

class Document;
class PropertiesPanel;
class SceneTree;
class SceneView;

/// Keeps view, tree, properties and menus consistent with selection and edits.
class SceneEditing : public QObject {
  Q_OBJECT

 public:
  /// @param workbench outlives it.
  explicit SceneEditing(Workbench& workbench);

  [[nodiscard]] EditActions& actions() { return edit_actions_; }
  [[nodiscard]] ArrangeActions& arrange() { return arrange_actions_; }
  [[nodiscard]] ResizeTool& resize() { return resize_; }
  /// Returns the tree, to be put into a dock.
  [[nodiscard]] SceneTree& tree() const { return *tree_; }
  [[nodiscard]] PropertiesPanel* properties() const { return properties_; }

  /// Adds a mesh from a file, or emits failed().
  void add_mesh(const QString& file);
  /// Handles drops of objects from the tree into the view.
  bool eventFilter(QObject* watched, QEvent* event) override;
  /// Shows or hides the handles of the selection, if it can be moved.
  void show_handles(bool shown);

 private:
  void connect_view();
  void connect_tree();
  void add_docks();
  void show_selection();
  void show_edit(const planning::SceneState& before);
  void update_gizmo();
  void preview(const planning::SceneState& state);
  /// Shows beside the pointer which objects the dragged ones overlap.
  void show_overlaps(const planning::SceneState& state);
  void attach(const std::string& robot, const std::string& link);
  /// @throws InputError if the mesh can't be read.
  void import_mesh(const QString& file);
  void add_shape(const QString& name, const geometric::Shape& shape);
  void show_context_menu(const SceneItem& item, bool by_key, const QPoint& place);
  /// Objects that were dragged somewhere.
  void drop_in_tree(const std::vector<std::string>& names, const SceneItem& onto);
  void drop_in_view(const std::vector<std::string>& names, const QPoint& place);

  Workbench& workbench_;
  const Document& document_;
  SceneView& view_;
  SceneEditor& editor_;
  EditActions edit_actions_;
  ArrangeActions arrange_actions_;
  ResizeTool resize_;
  CloudTool clouds_;
  SceneTree* tree_;
  PropertiesPanel* properties_;
  CollisionReport report_;
  bool has_handles_ = true;
};

/// Draws the scene's constraints into the view, for the posture on screen.
class ConstraintDisplay : public QObject {
  Q_OBJECT

 public:
  /// The document and the view outlive it.
  ConstraintDisplay(Document& document, SceneView& view, QObject* parent = nullptr);

  void show();

 private:
  Document& document_;
  SceneView& view_;
};

/// Adds the scene's tree, properties, history and editing commands, autosave, and handles.
void add_editing(Workbench& workbench);

}  // namespace handway::gui
