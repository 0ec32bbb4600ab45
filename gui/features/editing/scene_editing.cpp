#include "features/editing/scene_editing.h"

#include "features/editing/frame_tool.h"
#include "features/editing/goal_pose_tool.h"
#include "features/editing/mesh_import.h"
#include "features/editing/palm_tool.h"
#include "features/editing/properties_panel.h"
#include "features/editing/scene_tree.h"
#include "features/workbench.h"
#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/resources.h"
#include "handway/planning/edits/arranging.h"
#include "handway/planning/edits/resizing.h"
#include "model/document/document.h"
#include "view3d/constraint_drawings.h"
#include "view3d/overlay.h"
#include "view3d/scene_view.h"
#include "view3d/view_gizmo.h"
#include "widgets/panels/floating_card.h"
#include "widgets/panels/log_panel.h"

#include <QDropEvent>
#include <QFileDialog>
#include <QLocale>
#include <QMainWindow>
#include <QMimeData>
#include <QUndoView>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

namespace handway::gui {
Recovery::Recovery(Workbench& workbench)
    : document_(workbench.document),
      editor_(workbench.editor),
      planning_(workbench.plan_settings),
      banner_(workbench.banner),
      autosave_(Autosave::default_folder()) {
  const auto follow = [this, &workbench] { set_enabled(workbench.preferences.values().autosave); };
  connect(&workbench.preferences, &Preferences::changed, this, follow);
  connect(&workbench, &Workbench::begun, this, [this, &workbench] {
    if (workbench.options.screenshot.empty()) {
      offer();
    }
  });
  connect(this, &Recovery::failed, &workbench, [&workbench](const QString& message) {
    workbench.log.add(LogPanel::Level::kError, tr("Unsaved changes are not kept: %1").arg(message));
  });
  follow();
  connect(&autosave_, &Autosave::stored, this, [this] { fails_ = false; });
  connect(&autosave_, &Autosave::failed, this, [this](const QString& message) {
    if (!std::exchange(fails_, true)) {
      emit failed(message);
    }
  });
  connect(&document_, &Document::edited, this, [this](const planning::SceneState& before) {
    if (before.scene != document_.scene()) {
      store(std::nullopt);
    }
  });
  connect(&editor_, &SceneEditor::modified_changed, this, [this](bool modified) {
    if (!modified) {
      autosave_.clear();
    }
  });
  connect(&document_, &Document::opened, this, [this](Document::Opened what) {
    if (what == Document::Opened::kRobots) {
      return;  // an edit
    }
    if (recovering_ && document_.file() == recovering_->file) {
      editor_.undo_stack().resetClean();
      store(recovering_);
    } else {
      autosave_.clear();
    }
    recovering_.reset();
  });
  connect(&document_, &Document::open_failed, this, [this] { recovering_.reset(); });
}

void Recovery::set_enabled(bool enabled) {
  if (enabled != enabled_) {
    enabled_ = enabled;
    if (!enabled) {
      autosave_.clear();
    } else if (document_.scene() && editor_.is_modified()) {
      store(std::nullopt);
    }
  }
}

void Recovery::store(const std::optional<LostScene>& then_forget) {
  if (!enabled_) {
    return;
  }
  const QString name = QString::fromStdString(document_.scene()->name);
  autosave_.store(
      {document_.loaded(), document_.configuration(), planning_.choice(), document_.file(), name},
      then_forget);
}

void Recovery::offer() {
  const std::vector<LostScene> lost = autosave_.find_lost();
  if (lost.empty()) {
    return;
  }
  const LostScene& last = lost.front();
  const QString name = !last.name.isEmpty() ? last.name
                       : last.file.empty()  ? tr("a new scene")
                                            : QString::fromStdString(last.file.filename().string());
  banner_.offer(
      tr("Unsaved changes to %1").arg(name),
      tr("The program ended without saving them, %1.")
          .arg(QLocale().toString(last.time, QLocale::ShortFormat)),
      tr("Recover"), [this, last] { recover(last); }, tr("Discard"),
      [last] { Autosave::forget(last); });
}

void Recovery::recover(const LostScene& lost) {
  recovering_ = lost;
  document_.open_copy(lost.scene, lost.file);
}

namespace {

// Distinguishable with any kind of colour vision. Source: Okabe, Ito, "Color Universal Design",
// 2008, a little paler.
constexpr std::array<geometric::Color, 6> kNewColors{{{0.36F, 0.56F, 0.80F, 1.0F},
                                                      {0.90F, 0.66F, 0.23F, 1.0F},
                                                      {0.24F, 0.64F, 0.53F, 1.0F},
                                                      {0.80F, 0.52F, 0.67F, 1.0F},
                                                      {0.47F, 0.73F, 0.90F, 1.0F},
                                                      {0.83F, 0.80F, 0.36F, 1.0F}}};

// Colours of the objects of the library: wood, lacquer, glass.
const std::map<std::string, geometric::Color>& library_colors() {
  static const std::map<std::string, geometric::Color> kColors{
      {"can", {0.80F, 0.16F, 0.14F, 1.0F}},   {"desk", {0.82F, 0.68F, 0.50F, 1.0F}},
      {"mug", {0.16F, 0.52F, 0.42F, 1.0F}},   {"open_box", {0.60F, 0.70F, 0.80F, 0.5F}},
      {"shelf", {0.86F, 0.76F, 0.62F, 1.0F}}, {"t_shape", {0.85F, 0.38F, 0.18F, 1.0F}},
      {"table", {0.72F, 0.56F, 0.38F, 1.0F}}};
  return kColors;
}

// The first of them that fewest objects have.
geometric::Color new_color(const geometric::Scene& scene) {
  return *std::ranges::min_element(kNewColors, {}, [&](const geometric::Color& color) {
    return std::ranges::count(scene.objects, color, &geometric::SceneObject::color);
  });
}

}  // namespace

SceneEditing::SceneEditing(Workbench& workbench)
    : workbench_(workbench),
      document_(workbench.document),
      view_(workbench.view),
      editor_(workbench.editor),
      edit_actions_(workbench),
      arrange_actions_(workbench),
      resize_(editor_, view_),
      clouds_(workbench),
      tree_(new SceneTree),
      properties_(new PropertiesPanel(editor_)) {
  edit_actions_.setParent(this);
  arrange_actions_.setParent(this);
  resize_.setParent(this);
  add_docks();
  connect(&document_, &Document::edited, this, &SceneEditing::show_edit);
  connect(&document_, &Document::opened, this, &SceneEditing::show_selection);
  connect(&document_, &Document::configuration_changed, this, [this] {
    update_gizmo();
    properties_->refresh();
  });
  connect(&editor_, &SceneEditor::selection_changed, this, &SceneEditing::show_selection);
  connect(&workbench_.collisions, &CollisionMonitor::checked, this,
          [this](const CollisionReport& report) { report_ = report; });
  connect(&workbench_, &Workbench::scene_shown, this,
          [this] { tree_->set_scene(document_.scene()); });
  connect(&workbench_, &Workbench::mesh_dropped, this, &SceneEditing::add_mesh);
  connect(&workbench_, &Workbench::handles_welcome, this, &SceneEditing::show_handles);
  connect(&workbench_, &Workbench::theme_changed, this, [this] {
    tree_->refresh_icons();
    properties_->refresh_icons();
  });
  connect(properties_, &PropertiesPanel::mount_requested, &editor_, &SceneEditor::mount);
  connect(properties_, &PropertiesPanel::attach_requested, this, &SceneEditing::attach);
  connect(&edit_actions_, &EditActions::add_requested, this, &SceneEditing::add_shape);
  connect(&edit_actions_, &EditActions::attach_requested, this, [this] {
    const geometric::RobotInstance& robot = *document_.robot();
    attach(robot.name, robot.model->link(document_.palm()).name);
  });
  connect(&editor_, &SceneEditor::refused, &workbench_, &Workbench::show_error);
  connect(&edit_actions_, &EditActions::add_mesh_requested, this, &SceneEditing::add_mesh);
  connect(properties_, &PropertiesPanel::cells_edited, &clouds_, &CloudTool::set_cells);
  connect(&clouds_, &CloudTool::cells_kept, properties_, &PropertiesPanel::refresh);
  connect(&edit_actions_, &EditActions::add_cloud_requested, &clouds_, [this] { clouds_.add({}); });
  connect_view();
  connect_tree();
}

void SceneEditing::add_docks() {
  workbench_.add_dock(DockArea::kLeft, 0, {"scene", tr("Scene"), tree_, 290});
  workbench_.add_dock(DockArea::kLeft, 1, {"properties", tr("Properties"), properties_, 350});
  auto* history = new QUndoView(&editor_.undo_stack());
  history->setEmptyLabel(tr("As opened"));
  history->setAccessibleName(tr("History"));
  workbench_.add_dock(DockArea::kHistory, 0, {"history", tr("History"), history});
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
              workbench_.session.try_scene(*state);
              show_overlaps(*state);
            }
          });
  connect(&view_, &SceneView::context_requested, this, &SceneEditing::show_context_menu);
  view_.setAcceptDrops(true);
  view_.installEventFilter(this);
  view_.set_face_snap([this](const geometric::Pose& X_WO, double reach) {
    const auto state = editor_.placed(X_WO);
    return state ? planning::shift_to_sides(*state->scene, document_.configuration(),
                                            editor_.changeable(), reach)
                 : Eigen::Vector3d::Zero().eval();
  });
  connect(&resize_, &ResizeTool::tried, &workbench_.session, &PlanningSession::try_scene);
  connect(edit_actions_.resize, &QAction::toggled, this, [this](bool on) {
    resize_.set_wanted(on);
    update_gizmo();
  });
  connect(edit_actions_.local, &QAction::toggled, &view_, &SceneView::set_gizmo_local);
}

void SceneEditing::connect_tree() {
  connect(tree_, &SceneTree::ghosts_toggled, &view_, &SceneView::show_ghosts);
  connect(tree_, &SceneTree::posture_activated, this, [this](const SceneItem& item) {
    const geometric::Scene& scene = *document_.scene();
    workbench_.posing.set(item.kind == SceneItem::Kind::kStart ? *scene.start : *scene.goal);
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
  connect(tree_, &SceneTree::objects_dropped, this, &SceneEditing::drop_in_tree);
  connect(tree_, &QWidget::customContextMenuRequested, this, [this](const QPoint& place) {
    workbench_.show_context_menu(tree_->viewport()->mapToGlobal(place));
  });
  connect(&edit_actions_, &EditActions::rename_requested, tree_, &SceneTree::edit_name);
}

// A click beside what is selected selects what it meets.
void SceneEditing::show_context_menu(const SceneItem& item, bool by_key, const QPoint& place) {
  const std::vector<std::string>& selected = editor_.selected_objects();
  const bool is_selected =
      item == editor_.selection() ||
      (item.kind == SceneItem::Kind::kObject && std::ranges::count(selected, item.name) > 0);
  if (!by_key && !is_selected) {
    editor_.click(item, false);
  }
  workbench_.show_context_menu(place);
}

bool SceneEditing::eventFilter(QObject* watched, QEvent* event) {
  // QDropEvent is the base class of all these events.
  if (event->type() == QEvent::DragEnter || event->type() == QEvent::DragMove ||
      event->type() == QEvent::Drop) {
    auto& drag = *static_cast<QDropEvent*>(event);
    const bool is_ours = drag.mimeData()->hasFormat(QLatin1String(SceneTree::kDraggedObjects));
    drag.setAccepted(is_ours);
    if (is_ours && event->type() == QEvent::Drop) {
      drop_in_view(SceneTree::dragged_objects(*drag.mimeData()), drag.pos());
    }
    return is_ours;
  }
  return QObject::eventFilter(watched, event);
}

void SceneEditing::drop_in_tree(const std::vector<std::string>& names, const SceneItem& onto) {
  if (onto.kind == SceneItem::Kind::kLink) {
    editor_.select_objects(names);
    attach(onto.robot, onto.name);
  } else {
    editor_.move_into_group(names, onto.kind == SceneItem::Kind::kObject
                                       ? editor_.state().display_of(onto.name).group
                                       : onto.name);
  }
}

void SceneEditing::drop_in_view(const std::vector<std::string>& names, const QPoint& place) {
  const auto hit = view_.pick_at(place);
  if (hit && hit->item.kind == SceneItem::Kind::kLink) {
    drop_in_tree(names, hit->item);
    return;
  }
  const Ray ray = ray_through(view_.camera(), view_.size(), place);
  const double to_floor = -ray.origin.z() / ray.direction.z();
  const Eigen::Vector3d foot = hit ? hit->point
                               : to_floor > 0.0
                                   ? Eigen::Vector3d(ray.origin + to_floor * ray.direction)
                                   : view_.place_for_new();
  editor_.put_at(names, foot);
}

void SceneEditing::add_shape(const QString& name, const geometric::Shape& shape) {
  if (!document_.scene()) {
    return;
  }
  const Eigen::Vector3d size = geometric::bounding_box(*geometric::tessellate(shape)).size();
  editor_.add(name.toStdString(), shape, new_color(*document_.scene()),
              editor_.place_for(size, view_.place_for_new()));
  view_.keep_selection_in_view();
}

void SceneEditing::show_selection() {
  view_.set_selection(editor_.whole_selection());
  tree_->select(editor_.whole_selection());
  edit_actions_.update_enabled();
  arrange_actions_.update_enabled();
  properties_->refresh();
  update_gizmo();
}

void SceneEditing::show_edit(const planning::SceneState& /*before*/) {
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
                       editor_.selection().kind == SceneItem::Kind::kRobot ||
                       editor_.selected_goal_pose() != nullptr ||
                       editor_.selected_frame() != nullptr;
  const std::vector<std::string>& objects = editor_.selected_objects();
  const bool hidden = !objects.empty() && std::ranges::all_of(objects, [&](const auto& name) {
    return editor_.state().is_hidden(name);
  });
  const SceneItem item =
      editor_.has_several() ? SceneItem{SceneItem::Kind::kSeveral, "", ""} : editor_.selection();
  const bool resizes = resize_.update();
  const auto X_WO =
      has_handles_ && movable && !hidden && !resizes ? editor_.selected_pose() : std::nullopt;
  const geometric::SceneObject* object = editor_.selected_object();
  view_.set_gizmo(item, X_WO,
                  object && !editor_.has_several()
                      ? geometric::bounding_box(*geometric::tessellate(object->shape)).centre()
                      : Eigen::Vector3d::Zero().eval());
}

void SceneEditing::preview(const planning::SceneState& state) {
  for (const std::string& name : editor_.changeable()) {
    view_.preview(object_item(name),
                  object_pose(*state.scene, document_.configuration(), *state.find(name)));
  }
}

void SceneEditing::show_overlaps(const planning::SceneState& state) {
  const planning::ObjectNames others = planning::sunk_into(*state.scene, editor_.changeable());
  if (!others.empty()) {
    view_.add_to_note(tr("overlaps %1").arg(SceneEditor::words_for(others)));
  }
}

void SceneEditing::attach(const std::string& robot, const std::string& link) {
  if (link.empty()) {
    editor_.detach();
    return;
  }
  // Links that touch it now may touch it from now on.
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
                           &workbench_.window, tr("Add a mesh"), {},
                           tr("Meshes (*.stl *.obj *.dae *.ply *.glb *.gltf);;All files (*)"))
                     : file;
  if (chosen.isEmpty() || !document_.scene()) {
    return;
  }
  try {
    import_mesh(chosen);
  } catch (const std::exception& error) {
    workbench_.show_error(tr("The mesh can't be added"), QString::fromUtf8(error.what()));
  }
}

void SceneEditing::import_mesh(const QString& file) {
  geometric::Mesh mesh;
  mesh.file = std::filesystem::absolute(file.toStdString());
  mesh.triangles = geometric::read_mesh(mesh.file);
  Eigen::Matrix3d R_WO = Eigen::Matrix3d::Identity();
  bool is_hollow = false;
  geometric::Color color = new_color(*document_.scene());
  if (mesh.file.parent_path() == geometric::resource_dir() / "objects") {
    const auto own = library_colors().find(mesh.file.stem().string());
    color = own == library_colors().end() ? color : own->second;
  } else {
    const bool knows_units = geometric::has_extension(mesh.file, ".dae") ||
                             geometric::has_extension(mesh.file, ".glb") ||
                             geometric::has_extension(mesh.file, ".gltf");
    MeshImportDialog dialog(file, mesh.triangles, knows_units, &workbench_.window);
    if (dialog.exec() != QDialog::Accepted) {
      return;
    }
    mesh = planning::scaled(mesh, dialog.scale());
    R_WO = dialog.orientation();
    is_hollow = dialog.is_hollow();
  }
  geometric::Pose X_WO = geometric::Pose::Identity();
  X_WO.linear() = R_WO;
  if (is_hollow) {
    editor_.add_room(mesh.file.stem().string(), mesh, color, X_WO);
    return;
  }
  const Eigen::Vector3d size =
      geometric::bounding_box(geometric::transformed(*mesh.triangles, X_WO)).size();
  editor_.add(mesh.file.stem().string(), mesh, color,
              editor_.place_for(size, view_.place_for_new()), R_WO);
  view_.keep_selection_in_view();
}

ConstraintDisplay::ConstraintDisplay(Document& document, SceneView& view, QObject* parent)
    : QObject(parent), document_(document), view_(view) {
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

void add_editing(Workbench& workbench) {
  workbench.own<SceneEditing>(workbench);
  workbench.own<Recovery>(workbench);
  auto& palm = workbench.own<PalmTool>(workbench.document, workbench.editor, workbench.posing,
                                       workbench.session, workbench.view);
  QObject::connect(&palm, &PalmTool::refused, &workbench, &Workbench::show_error);
  workbench.own<GoalPoseTool>(workbench);
  workbench.own<FrameTool>(workbench);
  auto& constraints = workbench.own<ConstraintDisplay>(workbench.document, workbench.view);
  QObject::connect(&workbench, &Workbench::scene_shown, &constraints, &ConstraintDisplay::show);
}

}  // namespace handway::gui
