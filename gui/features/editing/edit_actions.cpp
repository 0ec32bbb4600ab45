#include "features/editing/edit_actions.h"

#include "features/editing/array_tool.h"
#include "handway/geometric/io/resources.h"
#include "model/document/scene_edits.h"
#include "model/document/selection.h"
#include "widgets/style/icons.h"

#include <QMainWindow>
#include <QMenu>
#include <QToolBar>
#include <QToolButton>

#include <algorithm>
#include <array>
#include <utility>

namespace handway::gui {
namespace {

QString as_title(const std::string& name) {
  QString words = QString::fromStdString(name);
  words.replace('_', ' ');
  return words.left(1).toUpper() + words.mid(1);
}

}  // namespace

EditActions::EditActions(QMainWindow& window, QMenu& edit_menu, QMenu& add_menu, QToolBar& bar,
                         SceneEditor& editor)
    : QObject(&window), window_(window), editor_(editor), add_button_(new QToolButton) {
  undo = editor_.undo_stack().createUndoAction(&window_, tr("&Undo"));
  redo = editor_.undo_stack().createRedoAction(&window_, tr("&Redo"));
  take(*undo, "undo", QKeySequence::Undo, tr("Take the last edit back"));
  take(*redo, "redo", QKeySequence(QStringLiteral("Ctrl+Shift+Z")), tr("Make it again"));
  rename = make("", tr("Re&name"), QKeySequence(Qt::Key_F2),
                tr("Give the object or group another name"));
  duplicate = make("duplicate", tr("&Duplicate"), QKeySequence(QStringLiteral("Ctrl+D")),
                   tr("Put a copy beside the object"));
  remove = make("delete", tr("D&elete"), QKeySequence::Delete, tr("Take the object away"));
  drop = make("drop", tr("Drop to &surface"), QKeySequence(Qt::Key_End),
              tr("Let the object stand on what is below it"));
  hide = make("hide", tr("&Hide"), QKeySequence(Qt::Key_H), tr("Do not draw the object"));
  lock = make("lock", tr("&Lock"), QKeySequence(QStringLiteral("Ctrl+L")),
              tr("Keep the object from being changed"));
  local = make("local_axes", tr("&Own axes"), QKeySequence(Qt::Key_L),
               tr("Handles along the object's own axes, not the world's"));
  resize = make("resize", tr("Resi&ze by hand"), QKeySequence(Qt::Key_S),
                tr("Knobs on the object's sides, to make it larger or smaller"));
  grasp = make("posture", tr("&Grasp…"), QKeySequence(QStringLiteral("Ctrl+G")),
               tr("Choose a way to grasp the object and plan to it"));
  palm = make("palm", tr("Move the &palm"), QKeySequence(Qt::Key_M),
              tr("Handles on the palm: the arm follows"));
  for (QAction* action : {hide, lock, local, palm, resize}) {
    action->setCheckable(true);
  }
  edit_menu.addActions({undo, redo});
  edit_menu.addSeparator();
  edit_menu.addActions({rename, duplicate, remove});
  edit_menu.addSeparator();
  edit_menu.addActions({drop, hide, lock});
  edit_menu.addSeparator();
  edit_menu.addActions({grasp, palm, resize, local});
  fill_add_menu(add_menu);
  bar.addActions({undo, redo});
  add_button_->setObjectName(QStringLiteral("add_object"));
  add_button_->setText(tr("Add"));
  add_button_->setToolTip(tr("Add an object to the scene"));
  add_button_->setMenu(&add_menu);
  add_button_->setPopupMode(QToolButton::InstantPopup);
  add_button_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  bar.addWidget(add_button_);
  bar.addActions({duplicate, remove, drop, grasp, palm, resize, local});

  connect(rename, &QAction::triggered, this, [this] { emit rename_requested(); });
  connect(duplicate, &QAction::triggered, &editor_, &SceneEditor::duplicate);
  connect(remove, &QAction::triggered, &editor_, &SceneEditor::remove);
  connect(drop, &QAction::triggered, &editor_, &SceneEditor::drop);
  connect(hide, &QAction::triggered, this,
          [this](bool on) { editor_.set_hidden(editor_.selected_objects(), on); });
  connect(lock, &QAction::triggered, this,
          [this](bool on) { editor_.set_locked(editor_.selected_objects(), on); });
  connect(palm, &QAction::triggered, this, [this](bool on) {
    editor_.select(on ? SceneItem{SceneItem::Kind::kPalm, "", ""} : SceneItem{});
  });
  refresh_icons();
  update_enabled();
}

void EditActions::fill_add_menu(QMenu& menu) {
  const auto add_shape = [&](const char* name, const QString& title, const QString& object,
                             const geometric::Shape& shape) {
    QAction* action = make(name, title, {}, {});
    connect(action, &QAction::triggered, this,
            [this, object, shape] { emit add_requested(object, shape); });
    menu.addAction(action);
    adding_ << action;
  };
  add_shape("box", tr("&Box"), tr("box"), geometric::Box{});
  add_shape("cylinder", tr("&Cylinder"), tr("cylinder"), geometric::Cylinder{});
  add_shape("sphere", tr("&Sphere"), tr("sphere"), geometric::Sphere{});
  add_shape("cone", tr("C&one"), tr("cone"), geometric::Cone{});
  menu.addSeparator();
  const auto add_mesh = [&](const QString& title, const QString& file) {
    QAction* action = make("object", title, {}, {});
    connect(action, &QAction::triggered, this, [this, file] { emit add_mesh_requested(file); });
    menu.addAction(action);
    adding_ << action;
  };
  for (const std::string& name : geometric::resource_names(geometric::ResourceKind::kObject)) {
    const std::filesystem::path file =
        geometric::find_resource(geometric::ResourceKind::kObject, name, geometric::resource_dir());
    add_mesh(as_title(name), QString::fromStdString(file.string()));
  }
  menu.addSeparator();
  add_mesh(tr("&Mesh from file…"), {});
}

void EditActions::take(QAction& action, const QString& name, const QKeySequence& keys,
                       const QString& tip) {
  action.setObjectName(name);
  action.setShortcut(keys);
  action.setStatusTip(tip);
  if (!name.isEmpty()) {
    with_icon_ << &action;
  }
}

QAction* EditActions::make(const QString& name, const QString& text, const QKeySequence& keys,
                           const QString& tip) {
  QAction* action = make_action(window_, name, text, keys, tip);
  if (!name.isEmpty()) {
    with_icon_ << action;
  }
  return action;
}

void EditActions::refresh_icons() {
  add_button_->setIcon(icon("add"));
  for (QAction* action : with_icon_) {
    action->setIcon(icon(action->objectName()));
  }
}

void EditActions::update_enabled() {
  const bool has_scene = editor_.state().scene != nullptr;
  const geometric::SceneObject* object = editor_.selected_object();
  const bool can_change = editor_.can_change();
  for (QAction* action : adding_) {
    action->setEnabled(has_scene);
  }
  add_button_->setEnabled(has_scene);
  remove->setEnabled(can_change);
  rename->setEnabled(can_change &&
                     rigid_parts(*editor_.state().scene, editor_.selected_objects()).size() == 1);
  duplicate->setEnabled(object);
  drop->setEnabled(can_change && (editor_.has_several() || !object->attachment));
  hide->setEnabled(object);
  lock->setEnabled(object);
  grasp->setEnabled(object && !object->attachment && editor_.document().robot());
  palm->setEnabled(editor_.document().robot() != nullptr);
  palm->setChecked(editor_.selection().kind == SceneItem::Kind::kPalm);
  hide->setChecked(object && editor_.state().is_hidden(object->name));
  lock->setChecked(object && !can_change);
}

namespace {

constexpr std::array kAxes{"X", "Y", "Z"};

QString axis_name(int axis) { return QLatin1String(kAxes.at(static_cast<std::size_t>(axis))); }

}  // namespace

ArrangeActions::ArrangeActions(QMainWindow& window, QMenu& edit_menu, QToolBar& bar,
                               SceneEditor& editor, SceneView& view)
    : QObject(&window),
      window_(window),
      editor_(editor),
      align_menu_(new QMenu(tr("&Align"), &window)),
      distribute_menu_(new QMenu(tr("D&istribute"), &window)),
      button_(new QToolButton) {
  select_all = make("select_all", tr("Select &all"), "Ctrl+A", tr("Select every object"));
  array = make("array", tr("Arra&y…"), "Ctrl+Shift+A", tr("Copies in rows or around an axis"));
  group = make("group", tr("&Group"), "Ctrl+Shift+G",
               tr("Objects of a group are selected and moved together"));
  dissolve = make("ungroup", tr("&Ungroup"), "Ctrl+Shift+U", tr("Make single objects of a group"));
  fill_align_menu();
  fill_distribute_menu();
  auto* arrange = new QMenu(tr("Arrange"), &window_);
  for (QMenu* menu : {&edit_menu, arrange}) {
    menu->addSeparator();
    menu->addMenu(align_menu_);
    menu->addMenu(distribute_menu_);
    menu->addActions({array, group, dissolve});
  }
  edit_menu.addAction(select_all);
  button_->setObjectName(QStringLiteral("arrange"));
  button_->setText(tr("Arrange"));
  button_->setToolTip(tr("Align, distribute, repeat or group what is selected"));
  button_->setMenu(arrange);
  button_->setPopupMode(QToolButton::InstantPopup);
  bar.addWidget(button_);

  connect(select_all, &QAction::triggered, this, [this] {
    std::vector<std::string> names;
    for (const geometric::SceneObject& object : editor_.state().scene->objects) {
      names.push_back(object.name);
    }
    editor_.select_objects(std::move(names));
  });
  connect(group, &QAction::triggered, this, &ArrangeActions::make_group);
  connect(dissolve, &QAction::triggered, this, &ArrangeActions::ungroup);
  auto* tool = new ArrayTool(editor_, view, this);
  connect(array, &QAction::triggered, tool, &ArrayTool::begin);
  refresh_icons();
  update_enabled();
}

QAction* ArrangeActions::make(const char* name, const QString& text, const char* keys,
                              const QString& tip) {
  QAction* action =
      make_action(window_, QLatin1String(name), text, QKeySequence(QLatin1String(keys)), tip);
  with_icon_ << action;
  return action;
}

void ArrangeActions::fill_align_menu() {
  const std::array<std::pair<AlignTo, QString>, 3> kinds{{{AlignTo::kLeast, tr("%1: lower sides")},
                                                          {AlignTo::kCentre, tr("%1: centres")},
                                                          {AlignTo::kMost, tr("%1: upper sides")}}};
  for (int axis = 0; axis < 3; ++axis) {
    align_menu_->addSeparator();
    for (const auto& [to, text] : kinds) {
      QAction* action = align_menu_->addAction(text.arg(axis_name(axis)));
      action->setStatusTip(tr("To the object that was selected last"));
      connect(action, &QAction::triggered, this, [this, axis, to = to] { align(axis, to); });
    }
  }
}

void ArrangeActions::fill_distribute_menu() {
  for (int axis = 0; axis < 3; ++axis) {
    QAction* action = distribute_menu_->addAction(tr("Along %1").arg(axis_name(axis)));
    action->setStatusTip(tr("The same gap between all; the outermost stay"));
    connect(action, &QAction::triggered, this, [this, axis] { distribute(axis); });
  }
}

void ArrangeActions::refresh_icons() {
  button_->setIcon(icon("align"));
  align_menu_->setIcon(icon("align"));
  distribute_menu_->setIcon(icon("distribute"));
  for (QAction* action : with_icon_) {
    action->setIcon(icon(action->objectName()));
  }
}

void ArrangeActions::update_enabled() {
  const auto& scene = editor_.state().scene;
  const std::vector<std::string>& objects = editor_.selected_objects();
  const std::size_t parts = scene && editor_.can_change() ? rigid_parts(*scene, objects).size() : 0;
  const bool in_group = std::ranges::any_of(objects, [this](const std::string& name) {
    return !editor_.state().display_of(name).group.empty();
  });
  align_menu_->setEnabled(parts > 1);
  distribute_menu_->setEnabled(parts > 2);
  array->setEnabled(!objects.empty());
  group->setEnabled(parts > 1);
  dissolve->setEnabled(in_group && editor_.can_change());
  select_all->setEnabled(scene && !scene->objects.empty());
  button_->setEnabled(!objects.empty());
}

void ArrangeActions::align(int axis, AlignTo to) {
  const std::vector<std::string>& objects = editor_.selected_objects();
  SceneState next = aligned(editor_.state(), editor_.document().configuration(), objects, axis, to);
  if (next != editor_.state()) {
    editor_.apply(tr("Align %1 along %2").arg(SceneEditor::words_for(objects), axis_name(axis)),
                  std::move(next), objects);
  }
}

void ArrangeActions::distribute(int axis) {
  const std::vector<std::string>& objects = editor_.selected_objects();
  SceneState next = distributed(editor_.state(), editor_.document().configuration(), objects, axis);
  if (next != editor_.state()) {
    editor_.apply(
        tr("Distribute %1 along %2").arg(SceneEditor::words_for(objects), axis_name(axis)),
        std::move(next), objects);
  }
}

void ArrangeActions::make_group() {
  const std::vector<std::string> objects = editor_.selected_objects();
  const std::string name = unused_group(*editor_.state().scene, tr("group").toStdString());
  editor_.apply(
      tr("Group %1").arg(SceneEditor::words_for(objects)),
      with_changed_display(editor_.state(), objects, [&](auto& display) { display.group = name; }),
      objects);
}

void ArrangeActions::ungroup() {
  const std::vector<std::string> objects = editor_.selected_objects();
  editor_.apply(
      tr("Ungroup %1").arg(SceneEditor::words_for(objects)),
      with_changed_display(editor_.state(), objects, [](auto& display) { display.group.clear(); }),
      objects);
}

void ArrangeActions::rename_group(const std::string& name, const std::string& new_name) {
  if (new_name.empty() || new_name == name) {
    return;
  }
  const std::vector<std::string> members = group_members(*editor_.state().scene, name);
  const std::string unused = unused_group(*editor_.state().scene, new_name);
  editor_.apply(tr("Rename group %1").arg(QString::fromStdString(name)),
                with_changed_display(editor_.state(), members,
                                     [&](auto& display) { display.group = unused; }),
                members);
}

}  // namespace handway::gui
