#include "model/document/scene_editor.h"

#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/robot/inverse_kinematics.h"
#include "handway/planning/edits/arranging.h"
#include "handway/planning/edits/robot_edits.h"
#include "handway/planning/edits/scene_edits.h"
#include "model/document/edit.h"
#include "model/meshes/shaded_meshes.h"

#include <QStandardPaths>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace handway::gui {

using geometric::Pose;
using geometric::SceneObject;
using Kind = SceneItem::Kind;

namespace {

QString words(const std::string& name) { return QString::fromStdString(name); }

// Share of the selection's size along x and y: smaller objects are placed on top of it.
constexpr double kRoomOnTop = 0.8;

// Meshes of copied objects that no file holds go into a folder beside it.
std::filesystem::path clipboard_file() {
  return QStandardPaths::writableLocation(QStandardPaths::CacheLocation).toStdString() +
         "/copied.yaml";
}

}  // namespace

SceneEditor::SceneEditor(Document& document, QObject* parent)
    : QObject(parent), document_(document) {
  connect(&document_, &Document::opened, this, [this](Document::Opened what) {
    if (what == Document::Opened::kScene) {
      stack_.clear();
      stack_.setClean();  // an empty stack is not, where a scene was recovered before
      select({});
    }
  });
  const auto look = [this] {
    if (std::exchange(was_modified_, is_modified()) != was_modified_) {
      emit modified_changed(was_modified_);
    }
  };
  connect(&stack_, &QUndoStack::indexChanged, this, look);
  connect(&stack_, &QUndoStack::cleanChanged, this, look);
  connect(&composing_, &LatestJob::failed, this, &SceneEditor::end_composing);
}

bool SceneEditor::is_modified() const {
  const int saved = stack_.cleanIndex();
  const auto [first, last] = std::minmax({saved, stack_.index()});
  for (int i = first; saved >= 0 && i < last; ++i) {
    const auto* edit = dynamic_cast<const Edit*>(stack_.command(i));
    if (!edit || edit->is_saved()) {
      return true;
    }
  }
  return saved < 0;
}

void SceneEditor::push(const QString& text, planning::SceneState next, Selection select,
                       const std::string& kind) {
  stack_.push(new ValueEdit<Edited>(text, kind, true, {state(), selection_},
                                    {std::move(next), std::move(select)},
                                    [this](const Edited& edited) {
                                      document_.set_state(edited.state);
                                      set_selection(edited.selection);
                                    }));
}

void SceneEditor::apply(const QString& text, planning::SceneState next,
                        std::vector<std::string> select) {
  push(text, std::move(next), selection_of(std::move(select)));
}

QString SceneEditor::words_for(const std::vector<std::string>& objects) {
  return objects.size() == 1 ? words(objects.front())
                             : tr("%1 objects").arg(static_cast<int>(objects.size()));
}

void SceneEditor::set_selection(Selection selection) {
  selection_ = still_there(state(), std::move(selection));
  emit selection_changed(selection_.item);
}

void SceneEditor::select(const SceneItem& item) { set_selection(selection_of(item)); }

void SceneEditor::select_objects(std::vector<std::string> names) {
  set_selection(selection_of(std::move(names)));
}

void SceneEditor::click(const SceneItem& item, bool add) {
  set_selection(add ? toggled(state(), selection_, item) : clicked(state(), selection_, item));
}

const SceneObject* SceneEditor::selected_object() const {
  return selection_.item.kind == Kind::kObject ? state().find(selection_.item.name) : nullptr;
}

std::vector<std::string> SceneEditor::changeable() const {
  std::vector<std::string> names = selection_.objects;
  std::erase_if(names, [this](const std::string& name) {
    const SceneObject* object = state().find(name);
    return !object || state().is_locked(name);
  });
  return names;
}

std::optional<Pose> SceneEditor::selected_pose() const {
  if (const std::vector<std::string> names = changeable(); has_several() && !names.empty()) {
    return Pose(
        Eigen::Translation3d(bounds(*state().scene, document_.configuration(), names).centre()));
  }
  if (const SceneObject* object = selected_object()) {
    return object_pose(*state().scene, document_.configuration(), *object);
  }
  if (state().scene && selection().kind == Kind::kRobot) {
    return planning::base_pose(*state().scene, document_.configuration(), selection().robot);
  }
  if (const geometric::PoseGoal* goal = selected_goal_pose()) {
    return goal->X_WG;
  }
  if (const geometric::NamedFrame* frame = selected_frame()) {
    return planning::frame_pose(*state().scene, document_.configuration(), *frame);
  }
  if (const auto q = posture(selection())) {
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
                      const geometric::Color& color, const Eigen::Vector3d& foot,
                      const Eigen::Matrix3d& R_WO) {
  if (!state().scene) {
    return;
  }
  SceneObject object;
  object.name = name;
  object.shape = shape;
  object.color = color;
  object.X_PO.linear() = R_WO;
  const geometric::Aabb box =
      geometric::bounding_box(geometric::transformed(*geometric::tessellate(shape), object.X_PO));
  const Eigen::Vector3d underside(box.centre().x(), box.centre().y(), box.lower.z());
  object.X_PO.translation() = foot - underside;
  add_objects({object});
}

void SceneEditor::add_objects(const std::vector<SceneObject>& objects) {
  planning::SceneState next = state();
  std::vector<std::string> names;
  for (SceneObject object : objects) {
    object.name = planning::unused_name(*next.scene, object.name);
    names.push_back(object.name);
    next = with_object(next, std::move(object));
  }
  apply(tr("Add %1").arg(words_for(names)), std::move(next), names);
}

void SceneEditor::add_room(const std::string& name, const geometric::Shape& shape,
                           const geometric::Color& color, const Pose& X_WO) {
  if (!state().scene) {
    return;
  }
  SceneObject object;
  object.name = name;
  object.shape = shape;
  object.color = color;
  object.X_PO = X_WO;
  object.solid = false;
  add_objects({object});
}

Eigen::Vector3d SceneEditor::place_for(const Eigen::Vector3d& size,
                                       const Eigen::Vector3d& wanted) const {
  Eigen::Vector3d place = wanted;
  const geometric::Configuration& q = document_.configuration();
  if (!selection_.objects.empty()) {
    const geometric::Aabb selected = bounds(*state().scene, q, selection_.objects);
    const bool fits_on_top =
        (size.head<2>().array() < kRoomOnTop * selected.size().head<2>().array()).all();
    place << selected.centre().head<2>(), fits_on_top ? selected.upper.z() : selected.lower.z();
  }
  return free_foot(*state().scene, q, size, place);
}

std::string SceneEditor::constrained_body() const {
  const geometric::RobotInstance* robot = document_.robot();
  if (!robot || has_several()) {
    return {};
  }
  const SceneItem& item = selection();
  const SceneObject* object = selected_object();  // null while it is being renamed
  switch (item.kind) {
    case Kind::kObject:
      return object && is_carried_by(*object, *robot) ? item.name : std::string();
    case Kind::kLink:
      return item.robot == robot->name ? item.name : std::string();
    case Kind::kPalm:
      return robot->model->link(document_.palm()).name;
    default:
      return {};
  }
}

void SceneEditor::set_constraint(const geometric::PathConstraint& constraint) {
  const bool is_new = std::ranges::count(state().scene->constraints, constraint.name,
                                         &geometric::PathConstraint::name) == 0;
  push(tr("Constrain %1").arg(words(constraint.body)), with_constraint(state(), constraint),
       selection_, is_new ? std::string() : "constraint " + constraint.name);
}

void SceneEditor::remove_constraint(const std::string& name) {
  push(tr("Remove constraint %1").arg(words(name)), without_constraint(state(), name), selection_);
}

void SceneEditor::compose(const QString& text, std::function<planning::SceneState()> make,
                          Selection select, const std::string& kind, Outcome outcome) {
  end_composing(tr("Another edit came first."));
  outcome_ = outcome ? std::move(outcome) : [this, text](const QString& problem) {
    if (!problem.isEmpty()) {
      emit refused(tr("%1: this is not possible").arg(text), problem);
    }
  };
  composing_.run([this, text, make = std::move(make), select = std::move(select), kind,
                  from = state()](const std::stop_token&) -> LatestJob::Answer {
    planning::SceneState next = make();
    shade_meshes(*next.scene);
    return [this, text, next = std::move(next), select, kind, from] {
      const bool is_current = state() == from;
      if (is_current) {
        push(text, next, select, kind);
      }
      end_composing(is_current ? QString() : tr("The scene was edited meanwhile. Try again."));
    };
  });
}

void SceneEditor::end_composing(const QString& problem) {
  if (const Outcome outcome = std::exchange(outcome_, nullptr)) {
    outcome(problem);
  }
}

void SceneEditor::add_robot(geometric::RobotInstance robot,
                            const std::optional<planning::LinkOfRobot>& on, const Pose& X_LB,
                            Outcome outcome) {
  const std::string name = robot.name;
  compose(
      on ? tr("Mount %1").arg(words(name)) : tr("Add %1").arg(words(name)),
      [state = state(), q = document_.configuration(), robot = std::move(robot), on, X_LB] {
        return with_robot(state, q, robot, on, X_LB);
      },
      selection_of({Kind::kRobot, name, ""}), {}, std::move(outcome));
}

void SceneEditor::mount(const std::string& robot, const std::optional<planning::LinkOfRobot>& on) {
  if (on != planning::carrier_of(*state().scene, robot)) {
    compose(
        on ? tr("Mount %1").arg(words(robot)) : tr("Take off %1").arg(words(robot)),
        [state = state(), q = document_.configuration(), robot, on] {
          return on ? with_mount(state, q, robot, *on, Pose::Identity())
                    : without_mount(state, q, robot);
        },
        selection_of({Kind::kRobot, robot, ""}));
  }
}

void SceneEditor::set_model(const std::string& robot,
                            std::shared_ptr<const geometric::RobotModel> model, Outcome outcome) {
  compose(
      tr("Set up %1").arg(words(robot)),
      [state = state(), q = document_.configuration(), robot, model = std::move(model)] {
        return with_model(state, q, robot, model);
      },
      selection_, {}, std::move(outcome));
}

bool SceneEditor::can_remove_robot() const {
  return selection().kind == Kind::kRobot &&
         (state().scene->robots.size() > 1 ||
          planning::carrier_of(*state().scene, selection().robot));
}

void SceneEditor::put_first(const std::string& robot) {
  push(tr("Plan for %1").arg(words(robot)),
       with_first_robot(state(), document_.configuration(), robot),
       selection_of({Kind::kRobot, robot, ""}));
}

void SceneEditor::remove() {
  if (selected_goal_pose()) {
    push(tr("Delete goal pose"), without_goal_pose(state(), std::stoul(selection().name)), {});
    return;
  }
  if (selected_frame()) {
    push(tr("Delete %1").arg(words(selection().name)), without_frame(state(), selection().name),
         {});
    return;
  }
  if (can_remove_robot()) {
    const std::string name = selection().robot;
    compose(tr("Remove %1").arg(words(name)),
            [state = state(), q = document_.configuration(), name] {
              return without_robot(state, q, name);
            },
            {});
    return;
  }
  if (const std::vector<std::string> names = changeable(); !names.empty()) {
    apply(tr("Delete %1").arg(words_for(names)), without_objects(state(), names), {});
  }
}

void SceneEditor::duplicate() {
  const std::vector<std::string>& names = selection_.objects;
  if (names.empty()) {
    return;
  }
  const geometric::Configuration& q = document_.configuration();
  planning::Copies copies = planning::copied(
      state(), q, names, {motion_into_free(*state().scene, q, *state().scene, names)});
  apply(tr("Duplicate %1").arg(words_for(names)), std::move(copies.state), std::move(copies.names));
}

namespace {

// A file of the clipboard is not kept: the next copy may take its place.
void forget_file_in(const std::string& clipboard, std::filesystem::path& file) {
  if (file.string().starts_with(clipboard)) {
    file.clear();
  }
}

}  // namespace

std::string SceneEditor::copied() const {
  return geometric::objects_text(
      objects_alone(state(), document_.configuration(), selection_.objects), clipboard_file());
}

void SceneEditor::paste(const std::string& text) {
  geometric::Scene added =
      geometric::read_objects(text, tr("the clipboard").toStdString(), *state().scene);
  const std::string cache = clipboard_file().parent_path().string();
  std::vector<std::string> names;
  for (SceneObject& object : added.objects) {
    names.push_back(object.name);
    if (auto* mesh = std::get_if<geometric::Mesh>(&object.shape)) {
      forget_file_in(cache, mesh->file);
    } else if (auto* cloud = std::get_if<geometric::Cloud>(&object.shape)) {
      forget_file_in(cache, cloud->file);
    }
  }
  if (names.empty()) {
    return;
  }
  const geometric::Configuration& q = document_.configuration();
  planning::Copies copies =
      with_objects_of(state(), added, motion_into_free(*state().scene, q, added, names));
  const QString text_of_edit = tr("Paste %1").arg(words_for(copies.names));
  apply(text_of_edit, std::move(copies.state), std::move(copies.names));
}

void SceneEditor::put_at(const std::vector<std::string>& objects, const Eigen::Vector3d& foot) {
  select_objects(objects);
  const std::vector<std::string> names = changeable();
  if (names.empty()) {
    return;
  }
  const geometric::Configuration& q = document_.configuration();
  const planning::SceneState others = without_objects(state(), names);
  const geometric::Aabb box = bounds(*state().scene, q, names);
  const Eigen::Vector3d from(box.centre().x(), box.centre().y(), box.lower.z());
  const Eigen::Vector3d to = free_foot(*others.scene, q, box.size(), foot);
  push(tr("Move %1").arg(words_for(names)),
       moved(state(), q, names, Pose(Eigen::Translation3d(to - from))), selection_);
}

void SceneEditor::move_into_group(const std::vector<std::string>& objects,
                                  const std::string& group) {
  std::vector<std::string> moved;
  std::ranges::copy_if(objects, std::back_inserter(moved), [&](const std::string& name) {
    return !state().is_locked(name) && state().display_of(name).group != group;
  });
  if (!moved.empty()) {
    push((group.empty() ? tr("Take %1 out of its group")
                        : tr("Put %1 into %2").arg("%1", words(group)))
             .arg(words_for(moved)),
         with_changed_display(state(), moved, [&](auto& display) { display.group = group; }),
         selection_of(moved));
  }
}

void SceneEditor::rename(const std::string& name) {
  const std::string& old = selection().name;
  const bool is_frame = selected_frame() != nullptr;
  if (!(can_change() || is_frame) || has_several() || name.empty() || name == old) {
    return;
  }
  if (const std::string robot = planning::owner_of_name(*state().scene, name); !robot.empty()) {
    emit refused(tr("%1 keeps its name").arg(words(old)),
                 name == robot
                     ? tr("%1 is the name of a robot. Choose another one.").arg(words(name))
                     : tr("%1 is the name of a link of %2. Choose another one.")
                           .arg(words(name), words(robot)));
    return;
  }
  const std::string unused = planning::unused_name(*state().scene, name);
  if (is_frame) {
    push(tr("Rename %1").arg(words(old)), with_renamed_frame(state(), old, unused),
         selection_of(frame_item(unused)));
    return;
  }
  push(tr("Rename %1").arg(words(old)), with_renamed_object(state(), old, unused),
       selection_of(object_item(unused)));
}

void SceneEditor::change_selected(const QString& text, const std::string& what,
                                  const std::function<void(SceneObject&)>& change) {
  if (const std::vector<std::string> names = changeable(); !names.empty()) {
    push_changed(text, what, with_changed_objects(state(), names, change));
  }
}

void SceneEditor::push_changed(const QString& text, const std::string& what,
                               planning::SceneState next) {
  const std::vector<std::string> names = changeable();
  std::string key = what;
  for (const std::string& name : names) {
    key += what.empty() ? "" : '\n' + name;
  }
  push(text.arg(words_for(names)), std::move(next), selection_, key);
}

void SceneEditor::place(const Pose& X_WO) {
  if (selection().is_posture()) {
    emit palm_placed(selection(), X_WO);
    return;
  }
  if (const geometric::PoseGoal* selected = selected_goal_pose()) {
    geometric::PoseGoal goal = *selected;
    goal.X_WG = X_WO;
    push(tr("Move goal pose"), with_goal_pose(state(), std::stoul(selection().name), goal),
         selection_, "place of goal pose " + selection().name);
    return;
  }
  if (const geometric::NamedFrame* selected = selected_frame()) {
    geometric::NamedFrame frame = *selected;
    frame.X_PF = frame.X_PF * selected_pose().value().inverse() * X_WO;
    push(tr("Move %1").arg(words(frame.name)), with_frame(state(), frame), selection_,
         "place of frame " + frame.name);
    return;
  }
  if (selection().kind == Kind::kRobot) {
    const std::string robot = selection().robot;
    const QString text = tr("Move %1").arg(words(robot));
    if (!planning::carrier_of(*state().scene, robot)) {
      push(text, with_base(state(), robot, X_WO), selection_, "base " + robot);
      return;
    }
    compose(
        text,
        [state = state(), q = document_.configuration(), robot, X_WO] {
          return with_mount_at(state, q, robot, X_WO);
        },
        selection_, "base " + robot);
    return;
  }
  if (std::optional<planning::SceneState> next = placed(X_WO)) {
    const bool only_turned = X_WO.translation() == selected_pose()->translation();
    push_changed(only_turned ? tr("Turn %1") : tr("Move %1"), only_turned ? "turn" : "move",
                 std::move(*next));
  }
}

std::optional<planning::SceneState> SceneEditor::placed(const Pose& X_WO) const {
  const std::vector<std::string> names = changeable();
  if (names.empty()) {
    return std::nullopt;
  }
  const geometric::Configuration& q = document_.configuration();
  if (has_several()) {
    return moved(state(), q, names, X_WO * selected_pose()->inverse());
  }
  return with_changed_objects(state(), names, [&](SceneObject& changed) {
    changed.X_PO = in_parent(*state().scene, q, changed, X_WO);
  });
}

void SceneEditor::set_shape(const geometric::Shape& shape, const std::optional<Pose>& X_WO) {
  if (!has_several()) {
    change_selected(tr("Resize %1"), "size", [&](SceneObject& object) {
      object.shape = shape;
      if (X_WO) {
        object.X_PO = in_parent(*state().scene, document_.configuration(), object, *X_WO);
      }
    });
  }
}

void SceneEditor::set_color(const geometric::Color& color) {
  change_selected(tr("Colour %1"), "color", [&](SceneObject& object) { object.color = color; });
}

void SceneEditor::drop() {
  std::vector<std::string> names = changeable();
  std::erase_if(names, [this](const std::string& name) {
    return state().find(name)->attachment.has_value();
  });
  if (names.empty()) {
    return;
  }
  const planning::SceneState next = dropped(state(), document_.configuration(), names);
  if (next != state()) {
    push(tr("Drop %1").arg(words_for(names)), next, selection_);
  }
}

void SceneEditor::set_hidden(const std::vector<std::string>& objects, bool hidden) {
  if (std::ranges::any_of(objects, [&](const auto& o) { return state().is_hidden(o) != hidden; })) {
    push((hidden ? tr("Hide %1") : tr("Show %1")).arg(words_for(objects)),
         with_changed_display(state(), objects, [&](auto& display) { display.hidden = hidden; }),
         selection_);
  }
}

void SceneEditor::set_locked(const std::vector<std::string>& objects, bool locked) {
  if (std::ranges::any_of(objects, [&](const auto& o) { return state().is_locked(o) != locked; })) {
    push((locked ? tr("Lock %1") : tr("Unlock %1")).arg(words_for(objects)),
         with_changed_display(state(), objects, [&](auto& display) { display.locked = locked; }),
         selection_);
  }
}

void SceneEditor::set_solid(const std::vector<std::string>& objects, bool solid) {
  std::vector<std::string> changed;
  std::ranges::copy_if(objects, std::back_inserter(changed), [&](const std::string& name) {
    const SceneObject* object = state().find(name);
    return object && !state().is_locked(name) && object->solid != solid;
  });
  if (!changed.empty()) {
    push((solid ? tr("Make %1 Solid") : tr("Make %1 Hollow")).arg(words_for(changed)),
         with_changed_objects(state(), changed, [&](SceneObject& o) { o.solid = solid; }),
         selection_);
  }
}

void SceneEditor::keep_grasps(const std::string& object, const std::filesystem::path& file) {
  push(tr("Keep grasps of %1").arg(QString::fromStdString(object)),
       with_changed_object(state(), object, [&](SceneObject& o) { o.grasps = file; }), selection_);
}

void SceneEditor::attach(const std::string& robot, const std::string& link,
                         const std::vector<std::string>& touching) {
  const geometric::Configuration& q = document_.configuration();
  if (can_change() && link_pose(*state().scene, q, robot, link)) {
    // An object that touches its support could not be moved at all.
    const double rise = rise_to_clear(state(), changeable());
    const QString to = QString::fromStdString(robot + '/' + link);
    const QString text =
        rise > 0.0 ? tr("Attach %1 to %2, raised by %3 mm")
                         .arg(QStringLiteral("%1"), to, QString::number(1e3 * rise, 'f', 1))
                   : tr("Attach %1 to %2").arg(QStringLiteral("%1"), to);
    push_changed(text, "", attached(state(), q, changeable(), {robot, link}, touching));
  }
}

void SceneEditor::detach() {
  const bool any = std::ranges::any_of(changeable(), [this](const auto& name) {
    return state().find(name)->attachment.has_value();
  });
  if (any) {
    push_changed(tr("Detach %1"), "", detached(state(), document_.configuration(), changeable()));
  }
}

bool SceneEditor::can_add_goal_pose() const {
  const geometric::RobotInstance* robot = document_.robot();
  return robot && !geometric::chain_variables(*robot->model, document_.palm()).empty();
}

void SceneEditor::add_goal_pose() {
  if (!can_add_goal_pose()) {
    return;
  }
  const geometric::RobotInstance& robot = *document_.robot();
  geometric::PoseGoal goal;
  goal.link = robot.model->link(document_.palm()).name;
  goal.X_WG = *link_pose(*state().scene, document_.configuration(), robot.name, goal.link);
  const std::size_t index = state().scene->goal_poses.size();
  planning::SceneState next = with_goal_pose(state(), index, goal);
  if (!next.scene->start) {
    next = with_start(next, document_.configuration());
  }
  push(tr("Add goal pose"), std::move(next), selection_of(goal_pose_item(index)));
}

void SceneEditor::change_goal_pose(const geometric::PoseGoal& goal) {
  push(tr("Change goal pose"), with_goal_pose(state(), std::stoul(selection().name), goal),
       selection_, "goal pose " + selection().name);
}

void SceneEditor::add_frame(const Eigen::Vector3d& otherwise) {
  if (!state().scene) {
    return;
  }
  geometric::NamedFrame frame{planning::unused_name(*state().scene, "frame")};
  if (const SceneObject* object = selected_object()) {
    const Pose X_WO = object_pose(*state().scene, document_.configuration(), *object);
    const geometric::Aabb box = bounds(*state().scene, document_.configuration(), {object->name});
    const Eigen::Vector3d top(box.centre().x(), box.centre().y(), box.upper.z());
    frame.parent = object->name;
    frame.X_PF = X_WO.inverse() * Pose(Eigen::Translation3d(top));
  } else if (selection().kind == Kind::kLink && document_.robot() &&
             selection().robot == document_.robot()->name) {
    frame.parent = selection().name;
  } else if (selection().is_posture() && document_.robot()) {
    frame.parent = document_.robot()->model->link(document_.palm()).name;
  } else {
    frame.X_PF.translation() = otherwise;
  }
  push(tr("Add frame"), with_frame(state(), frame), selection_of(frame_item(frame.name)));
}

void SceneEditor::fix_frame(const std::string& parent) {
  const geometric::Configuration& q = document_.configuration();
  geometric::NamedFrame frame = *selected_frame();
  const Pose X_WF = selected_pose().value();
  frame.parent = parent;
  frame.X_PF = Pose::Identity();
  frame.X_PF = planning::frame_pose(*state().scene, q, frame).value().inverse() * X_WF;
  push(tr("Fix %1").arg(words(frame.name)), with_frame(state(), frame), selection_);
}

void SceneEditor::set_group(const std::vector<std::string>& group) {
  if (group == state().scene->group) {
    return;
  }
  QStringList names;
  for (const std::string& name : group) {
    names << words(name);
  }
  const QString text =
      tr("Let %1 move").arg(names.isEmpty() ? tr("all joints") : names.join(QStringLiteral(", ")));
  if (planning::joins_robots(*state().scene, group)) {
    compose(
        text,
        [state = state(), q = document_.configuration(), group] {
          return with_group(state, q, group);
        },
        selection_);
  } else {
    push(text, with_group(state(), document_.configuration(), group), selection_);
  }
}

void SceneEditor::set_start(const geometric::Configuration& q) {
  if (document_.robot()) {
    push(tr("Set start"), with_start(state(), q), selection_);
  }
}

void SceneEditor::set_goal(const geometric::Configuration& q,
                           const std::optional<geometric::Configuration>& start) {
  if (document_.robot()) {
    const bool needs_start = start && !state().scene->start;
    push(tr("Set goal"), with_goal(needs_start ? with_start(state(), *start) : state(), q),
         selection_);
  }
}

void SceneEditor::keep_posture(const geometric::NamedPosture& posture) {
  if (document_.robot()) {
    push(tr("Save posture %1").arg(words(posture.name)), with_posture(state(), posture),
         selection_);
  }
}

void SceneEditor::forget_posture(const std::string& name) {
  if (document_.robot()) {
    push(tr("Delete posture %1").arg(words(name)), without_posture(state(), name), selection_);
  }
}

void SceneEditor::save_view(const geometric::SavedView& view) {
  push(tr("Save view %1").arg(words(view.name)), with_saved_view(state(), view), selection_);
}

void SceneEditor::forget_view(const std::string& name) {
  push(tr("Delete view %1").arg(words(name)), without_saved_view(state(), name), selection_);
}

void SceneEditor::use_basis(const std::filesystem::path& file,
                            std::shared_ptr<const sampling::PmdBasis> basis) {
  if (document_.robot()) {
    push(tr("Use basis %1").arg(words(file.stem().string())),
         with_basis(state(), file, std::move(basis)), selection_);
  }
}

}  // namespace handway::gui
