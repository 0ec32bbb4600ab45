#include "editing/scene_editor.h"

#include "editing/drop_height.h"
#include "editing/scene_edits.h"
#include "handway/geometric/io/mesh_reader.h"

#include <QElapsedTimer>

#include <utility>

namespace handway::gui {

using geometric::Pose;
using geometric::SceneObject;
using Kind = SceneItem::Kind;

namespace {

constexpr qint64 kOneGestureMs = 900;
constexpr int kMergeable = 1;

constexpr geometric::Color kMeshColor{0.62F, 0.66F, 0.71F, 1.0F};

QString words(const std::string& name) { return QString::fromStdString(name); }

SceneItem object_item(const std::string& name) { return {Kind::kObject, "", name}; }

}  // namespace

/// From one state to another and back.
class SceneEditor::Command : public QUndoCommand {
 public:
  Command(SceneEditor& editor, const QString& text, SceneState next, SceneItem select,
          std::string merge_key)
      : QUndoCommand(text),
        editor_(editor),
        before_(editor.state()),
        after_(std::move(next)),
        selected_before_(editor.selection()),
        selected_after_(std::move(select)),
        merge_key_(std::move(merge_key)) {
    age_.start();
  }

  void undo() override {
    editor_.document_.set_state(before_);
    editor_.select(selected_before_);
  }
  void redo() override {
    editor_.document_.set_state(after_);
    editor_.select(selected_after_);
  }
  [[nodiscard]] int id() const override { return merge_key_.empty() ? -1 : kMergeable; }
  bool mergeWith(const QUndoCommand* other) override {
    const auto* later = dynamic_cast<const Command*>(other);
    if (!later || later->merge_key_ != merge_key_ || age_.elapsed() > kOneGestureMs) {
      return false;
    }
    after_ = later->after_;
    selected_after_ = later->selected_after_;
    age_.restart();
    return true;
  }

 private:
  SceneEditor& editor_;
  SceneState before_;
  SceneState after_;
  SceneItem selected_before_;
  SceneItem selected_after_;
  std::string merge_key_;
  QElapsedTimer age_;
};

SceneEditor::SceneEditor(Document& document, QObject* parent)
    : QObject(parent), document_(document) {
  connect(&document_, &Document::opened, this, [this] {
    stack_.clear();
    select({});
  });
}

void SceneEditor::push(const QString& text, SceneState next, const SceneItem& select,
                       const std::string& merge_key) {
  stack_.push(new Command(*this, text, std::move(next), select, merge_key));
}

void SceneEditor::select(const SceneItem& item) {
  selection_ = item;
  emit selection_changed(selection_);
}

const SceneObject* SceneEditor::selected_object() const {
  return state().scene && selection_.kind == Kind::kObject
             ? geometric::find_object(*state().scene, selection_.name)
             : nullptr;
}

bool SceneEditor::can_change() const {
  return selected_object() && !state().locked.contains(selection_.name);
}

std::optional<Pose> SceneEditor::selected_pose() const {
  if (const SceneObject* object = selected_object()) {
    return object_pose(*state().scene, document_.configuration(), *object);
  }
  if (state().scene && selection_.kind == Kind::kRobot) {
    if (const auto* robot = geometric::find_robot(*state().scene, selection_.robot)) {
      return robot->X_WB;
    }
  }
  if (const auto q = posture(selection_)) {
    const geometric::RobotInstance& robot = *document_.robot();
    return link_pose(*state().scene, *q, robot.name, robot.model->link(document_.palm()).name);
  }
  return std::nullopt;
}

std::optional<geometric::Configuration> SceneEditor::posture(const SceneItem& item) const {
  if (!document_.robot()) {
    return std::nullopt;
  }
  switch (item.kind) {
    case Kind::kPalm:
      return document_.configuration();
    case Kind::kStart:
      return state().scene->start;
    case Kind::kGoal:
      return state().scene->goal;
    default:
      return std::nullopt;
  }
}

void SceneEditor::add(const std::string& name, const geometric::Shape& shape,
                      const geometric::Color& color, const Eigen::Vector3d& foot) {
  if (!state().scene) {
    return;
  }
  SceneObject object;
  object.name = unused_name(*state().scene, name);
  object.shape = shape;
  object.color = color;
  const geometric::Aabb box = geometric::bounding_box(*geometric::tessellate(shape));
  const Eigen::Vector3d underside(box.centre().x(), box.centre().y(), box.lower.z());
  object.X_PO.translation() = foot - underside;
  const SceneItem item = object_item(object.name);
  const QString title = tr("Add %1").arg(words(object.name));
  push(title, with_object(state(), std::move(object)), item);
}

void SceneEditor::add_mesh(const std::filesystem::path& file, const Eigen::Vector3d& foot) {
  geometric::Mesh mesh;
  mesh.file = std::filesystem::absolute(file);
  mesh.triangles = geometric::read_mesh(mesh.file);
  add(file.stem().string(), mesh, kMeshColor, foot);
}

void SceneEditor::remove() {
  if (can_change()) {
    const std::string name = selection_.name;
    push(tr("Delete %1").arg(words(name)), without_object(state(), name), {});
  }
}

void SceneEditor::duplicate() {
  if (!selected_object()) {
    return;
  }
  SceneObject copy = *selected_object();
  copy.name = unused_name(*state().scene, copy.name);
  const geometric::Aabb box = geometric::bounding_box(*geometric::tessellate(copy.shape));
  copy.X_PO.translation() += copy.X_PO.linear() * Eigen::Vector3d(0.0, 1.25 * box.size().y(), 0.0);
  const SceneItem item = object_item(copy.name);
  push(tr("Duplicate %1").arg(words(selection_.name)), with_object(state(), std::move(copy)), item);
}

void SceneEditor::rename(const std::string& name) {
  if (!can_change() || name.empty() || name == selection_.name) {
    return;
  }
  const std::string unused = unused_name(*state().scene, name);
  push(tr("Rename %1").arg(words(selection_.name)),
       with_renamed_object(state(), selection_.name, unused), object_item(unused));
}

void SceneEditor::change_selected(const QString& text, const std::string& what,
                                  const std::function<void(SceneObject&)>& change) {
  if (can_change()) {
    push(text.arg(words(selection_.name)), with_changed_object(state(), selection_.name, change),
         selection_, what.empty() ? what : what + ' ' + selection_.name);
  }
}

void SceneEditor::place(const Pose& X_WO) {
  if (selection_.is_posture()) {
    emit palm_placed(selection_, X_WO);
    return;
  }
  if (selection_.kind == Kind::kRobot) {
    push(tr("Move %1").arg(words(selection_.robot)), with_base(state(), selection_.robot, X_WO),
         selection_, "base " + selection_.robot);
    return;
  }
  const SceneObject* object = selected_object();
  if (!object) {
    return;
  }
  const Pose X_PO = in_parent(*state().scene, document_.configuration(), *object, X_WO);
  const bool only_turned = X_PO.translation() == object->X_PO.translation();
  change_selected(only_turned ? tr("Turn %1") : tr("Move %1"), only_turned ? "turn" : "move",
                  [&](SceneObject& changed) { changed.X_PO = X_PO; });
}

std::optional<SceneState> SceneEditor::placed(const Pose& X_WO) const {
  const SceneObject* object = selected_object();
  if (!object || !can_change()) {
    return std::nullopt;
  }
  const Pose X_PO = in_parent(*state().scene, document_.configuration(), *object, X_WO);
  return with_changed_object(state(), selection_.name,
                             [&](SceneObject& changed) { changed.X_PO = X_PO; });
}

void SceneEditor::set_shape(const geometric::Shape& shape) {
  change_selected(tr("Resize %1"), "size", [&](SceneObject& object) { object.shape = shape; });
}

void SceneEditor::set_color(const geometric::Color& color) {
  change_selected(tr("Colour %1"), "color", [&](SceneObject& object) { object.color = color; });
}

void SceneEditor::drop() {
  const SceneObject* object = selected_object();
  if (!object || object->attachment) {
    return;
  }
  Pose lowered = object->X_PO;
  lowered.translation().z() -= drop_height(*state().scene, *object);
  if (!lowered.isApprox(object->X_PO, 1e-12)) {
    change_selected(tr("Drop %1"), "", [&](SceneObject& changed) { changed.X_PO = lowered; });
  }
}

void SceneEditor::set_hidden(const std::string& object, bool hidden) {
  if (hidden != state().hidden.contains(object)) {
    push((hidden ? tr("Hide %1") : tr("Show %1")).arg(words(object)),
         with_hidden(state(), object, hidden), selection_);
  }
}

void SceneEditor::set_locked(const std::string& object, bool locked) {
  if (locked != state().locked.contains(object)) {
    push((locked ? tr("Lock %1") : tr("Unlock %1")).arg(words(object)),
         with_locked(state(), object, locked), selection_);
  }
}

void SceneEditor::attach(const std::string& robot, const std::string& link,
                         const std::vector<std::string>& touching) {
  const SceneObject* object = selected_object();
  const auto X_WL =
      object ? link_pose(*state().scene, document_.configuration(), robot, link) : std::nullopt;
  if (!X_WL) {
    return;
  }
  const Pose X_LO =
      X_WL->inverse() * object_pose(*state().scene, document_.configuration(), *object);
  change_selected(tr("Attach %1"), "", [&](SceneObject& changed) {
    changed.X_PO = X_LO;
    changed.attachment = geometric::Attachment{robot, link, touching};
  });
}

void SceneEditor::detach() {
  const SceneObject* object = selected_object();
  if (!object || !object->attachment) {
    return;
  }
  const Pose X_WO = object_pose(*state().scene, document_.configuration(), *object);
  change_selected(tr("Detach %1"), "", [&](SceneObject& changed) {
    changed.X_PO = X_WO;
    changed.attachment.reset();
  });
}

void SceneEditor::set_start(const geometric::Configuration& q) {
  if (document_.robot()) {
    push(tr("Set start"), with_start(state(), q), selection_);
  }
}

void SceneEditor::set_goal(const geometric::Configuration& q) {
  if (document_.robot()) {
    push(tr("Set goal"), with_goal(state(), q), selection_);
  }
}

}  // namespace handway::gui
