#include "features/editing/scene_editing.h"

#include "features/editing/properties_panel.h"
#include "features/editing/scene_tree.h"
#include "model/document/document.h"
#include "model/document/scene_edits.h"
#include "view3d/constraint_node.h"
#include "view3d/scene_view.h"

#include <QFileDialog>
#include <QMainWindow>

#include <algorithm>

namespace handway::gui {
namespace {

constexpr geometric::Color kNewColor{0.36F, 0.56F, 0.80F, 1.0F};

}  // namespace

SceneEditing::SceneEditing(const EditingParts& parts)
    : QObject(&parts.window),
      window_(parts.window),
      document_(parts.editor.document()),
      view_(parts.view),
      editor_(parts.editor),
      edit_actions_(window_, parts.edit_menu, parts.add_menu, parts.bar, editor_),
      arrange_actions_(window_, parts.edit_menu, parts.bar, editor_, view_),
      resize_(editor_, view_),
      tree_(new SceneTree),
      properties_(new PropertiesPanel(editor_)) {
  connect(&document_, &Document::edited, this, &SceneEditing::show_edit);
  connect(&document_, &Document::opened, this, &SceneEditing::show_selection);
  connect(&document_, &Document::configuration_changed, this, [this] {
    update_gizmo();
    properties_->refresh();
  });
  connect(&editor_, &SceneEditor::selection_changed, this, &SceneEditing::show_selection);
  connect(&parts.collisions, &CollisionMonitor::checked, this,
          [this](const CollisionReport& report) { report_ = report; });
  connect(properties_, &PropertiesPanel::attach_requested, this, &SceneEditing::attach);
  connect(&edit_actions_, &EditActions::add_requested, this,
          [this](const QString& name, const geometric::Shape& shape) {
            editor_.add(name.toStdString(), shape, kNewColor, view_.place_for_new());
          });
  connect(&edit_actions_, &EditActions::add_mesh_requested, this, &SceneEditing::add_mesh);
  connect_view();
}

void SceneEditing::connect_view() {
  connect(&view_, &SceneView::picked, &editor_, &SceneEditor::click);
  connect(&view_, &SceneView::dropped, this,
          [this](const SceneItem& /*item*/, const geometric::Pose& X_WO) { editor_.place(X_WO); });
  connect(&view_, &SceneView::dragged, this,
          [this](const SceneItem& item, const geometric::Pose& X_WO) {
            properties_->preview_pose(X_WO);
            if (const auto state = editor_.placed(X_WO)) {
              if (item.kind == SceneItem::Kind::kSeveral) {
                preview(*state);
              }
              emit tried(*state);
            }
          });
  connect(tree_, &SceneTree::item_selected, &editor_, &SceneEditor::select);
  connect(tree_, &SceneTree::objects_selected, &editor_, &SceneEditor::select_objects);
  connect(tree_, &SceneTree::objects_toggled, this,
          [this](const std::vector<std::string>& names, bool shown) {
            editor_.set_hidden(names, !shown);
          });
  connect(tree_, &SceneTree::object_renamed, this,
          [this](const std::string& name, const std::string& new_name) {
            editor_.select({SceneItem::Kind::kObject, "", name});
            editor_.rename(new_name);
            tree_->update_scene(editor_.state());
          });
  connect(tree_, &SceneTree::group_renamed, this,
          [this](const std::string& name, const std::string& new_name) {
            arrange_actions_.rename_group(name, new_name);
            tree_->update_scene(editor_.state());
          });
  connect(&resize_, &ResizeTool::tried, this, &SceneEditing::tried);
  connect(edit_actions_.resize, &QAction::toggled, this, [this](bool on) {
    resize_.set_wanted(on);
    update_gizmo();
  });
  connect(edit_actions_.local, &QAction::toggled, &view_, &SceneView::set_gizmo_local);
  connect(&edit_actions_, &EditActions::rename_requested, tree_, &SceneTree::edit_name);
}

void SceneEditing::refresh_icons() {
  edit_actions_.refresh_icons();
  arrange_actions_.refresh_icons();
  properties_->refresh_icons();
}

void SceneEditing::show_selection() {
  view_.set_selection(editor_.whole_selection());
  tree_->select(editor_.whole_selection());
  edit_actions_.update_enabled();
  arrange_actions_.update_enabled();
  properties_->refresh();
  update_gizmo();
}

void SceneEditing::show_edit(const SceneState& /*before*/) {
  view_.update_scene(editor_.state());
  tree_->update_scene(editor_.state());
  show_selection();
}

void SceneEditing::show_handles(bool shown) {
  has_handles_ = shown;
  update_gizmo();
}

void SceneEditing::update_gizmo() {
  const bool movable = editor_.can_change() || editor_.selection().is_posture() ||
                       editor_.selection().kind == SceneItem::Kind::kRobot;
  const std::vector<std::string>& objects = editor_.selected_objects();
  const bool hidden = !objects.empty() && std::ranges::all_of(objects, [&](const auto& name) {
    return editor_.state().is_hidden(name);
  });
  const SceneItem item =
      editor_.has_several() ? SceneItem{SceneItem::Kind::kSeveral, "", ""} : editor_.selection();
  const bool resizes = resize_.update();
  view_.set_gizmo(item, has_handles_ && movable && !hidden && !resizes ? editor_.selected_pose()
                                                                       : std::nullopt);
}

void SceneEditing::preview(const SceneState& state) {
  for (const std::string& name : editor_.changeable()) {
    view_.preview(object_item(name),
                  object_pose(*state.scene, document_.configuration(), *state.find(name)));
  }
}

void SceneEditing::attach(const std::string& robot, const std::string& link) {
  if (link.empty()) {
    editor_.detach();
    return;
  }
  // What it touches now it may touch from now on.
  std::vector<std::string> touching;
  for (const std::string& object : editor_.changeable()) {
    for (const geometric::NamedPair& pair : report_.collisions) {
      const std::string& other = pair.a == object ? pair.b : pair.a;
      if ((pair.a == object || pair.b == object) && other != link &&
          document_.robot()->model->find_link(other)) {
        touching.push_back(other);
      }
    }
  }
  editor_.attach(robot, link, touching);
}

void SceneEditing::add_mesh(const QString& file) {
  const QString chosen =
      file.isEmpty() ? QFileDialog::getOpenFileName(
                           &window_, tr("Add a mesh"), {},
                           tr("Meshes (*.stl *.obj *.dae *.ply *.glb *.gltf);;All files (*)"))
                     : file;
  if (chosen.isEmpty() || !document_.scene()) {
    return;
  }
  try {
    editor_.add_mesh(chosen.toStdString(), view_.place_for_new());
  } catch (const std::exception& error) {
    emit failed(tr("The mesh can't be added"), QString::fromUtf8(error.what()));
  }
}

ConstraintDisplay::ConstraintDisplay(Document& document, SceneView& view, QObject* parent)
    : QObject(parent), document_(document), view_(view) {
  connect(&document_, &Document::opened, this, &ConstraintDisplay::show);
  connect(&document_, &Document::edited, this, &ConstraintDisplay::show);
  connect(&document_, &Document::configuration_changed, this, [this] {
    if (document_.scene() && !document_.scene()->constraints.empty()) {
      show();
    }
  });
}

void ConstraintDisplay::show() {
  const auto& scene = document_.scene();
  if (!scene || scene->constraints.empty()) {
    view_.set_overlay(Overlay::kConstraints, nullptr);
    return;
  }
  view_.set_overlay(Overlay::kConstraints,
                    make_constraints_node(*scene, document_.configuration()));
}

}  // namespace handway::gui
