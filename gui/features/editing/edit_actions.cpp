#include "features/editing/edit_actions.h"

#include "features/editing/array_tool.h"
#include "features/workbench.h"
#include "handway/geometric/io/resources.h"
#include "handway/planning/edits/arranging.h"
#include "handway/planning/edits/scene_edits.h"
#include "model/document/selection.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/actions.h"
#include "widgets/style/icons.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QMainWindow>
#include <QMenu>
#include <QRegularExpression>
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

EditActions::EditActions(Workbench& workbench)
    : workbench_(workbench),
      editor_(workbench.editor),
      add_button_(named("add_object", new QToolButton)) {
  make_actions();
  fill_menu();
  fill_add_menu(workbench_.menu(MainMenu::kAdd));
  make_add_button();
  fill_bar();
  connect_actions();
  look_at_clipboard();
}

void EditActions::make_actions() {
  undo = editor_.undo_stack().createUndoAction(&workbench_.window, tr("&Undo"));
  redo = editor_.undo_stack().createRedoAction(&workbench_.window, tr("&Redo"));
  take(*undo, "undo", QKeySequence::Undo, tr("Take the last edit back"));
  take(*redo, "redo", QKeySequence(QStringLiteral("Ctrl+Shift+Z")), tr("Make it again"));
  rename = workbench_.make_action("", tr("Re&name"), QKeySequence(Qt::Key_F2),
                                  tr("Give the object or group another name"));
  cut = workbench_.make_action("", tr("Cu&t"), QKeySequence(QStringLiteral("Ctrl+X")),
                               tr("Copy the object and take it away"));
  copy = workbench_.make_action("", tr("&Copy"), QKeySequence(QStringLiteral("Ctrl+C")),
                                tr("Copy the object, for this scene, another one or a file"));
  paste = workbench_.make_action("", tr("&Paste"), QKeySequence(QStringLiteral("Ctrl+V")),
                                 tr("Add what was copied, in free space"));
  cut->setObjectName(QStringLiteral("cut"));
  copy->setObjectName(QStringLiteral("copy"));
  paste->setObjectName(QStringLiteral("paste"));
  attach = workbench_.make_action("", tr("A&ttach to the palm"), {},
                                  tr("Let the hand carry the object from where it is"));
  detach = workbench_.make_action("", tr("Det&ach"), {}, tr("Leave the object where it is"));
  attach->setObjectName(QStringLiteral("attach"));
  detach->setObjectName(QStringLiteral("detach"));
  duplicate =
      workbench_.make_action("duplicate", tr("&Duplicate"), QKeySequence(QStringLiteral("Ctrl+D")),
                             tr("Put a copy beside the object"));
  remove = workbench_.make_action("delete", tr("D&elete"), QKeySequence::Delete,
                                  tr("Take the object away"));
  drop = workbench_.make_action("drop", tr("Drop to &surface"), QKeySequence(Qt::Key_End),
                                tr("Let the object stand on what is below it"));
  hide = workbench_.make_action("hide", tr("&Hide"), QKeySequence(Qt::Key_H),
                                tr("Do not draw the object"));
  lock = workbench_.make_action("lock", tr("&Lock"), QKeySequence(QStringLiteral("Ctrl+L")),
                                tr("Keep the object from being changed"));
  local =
      workbench_.make_action("local_axes", tr("&Local axes"), QKeySequence(Qt::Key_L),
                             tr("Handles along the object's local axes instead of the world's"));
  resize =
      workbench_.make_action("resize", tr("Resi&ze with handles"), QKeySequence(Qt::Key_S),
                             tr("Handles on the object's sides, to make it larger or smaller"));
  palm = workbench_.make_action("palm", tr("Move the &palm"), QKeySequence(Qt::Key_M),
                                tr("Handles on the palm: the arm follows"));
  for (QAction* action : {hide, lock, local, palm, resize}) {
    action->setCheckable(true);
  }
}

void EditActions::fill_menu() {
  const std::vector<std::vector<QAction*>> sections{{undo, redo},
                                                    {cut, copy, paste, rename, duplicate, remove},
                                                    {drop, hide, lock},
                                                    {palm, resize, local}};
  for (std::size_t section = 0; section < sections.size(); ++section) {
    int order = 0;
    for (QAction* action : sections[section]) {
      const Position position{static_cast<int>(section), ++order};
      workbench_.add_to_menu(MainMenu::kEdit, position, action);
      if (section > 0) {
        workbench_.add_to_menu(MainMenu::kContext, position, action);
      }
    }
  }
  // These belong to an object's properties, where all links are listed.
  workbench_.add_to_menu(MainMenu::kContext, {2, 10}, attach);
  workbench_.add_to_menu(MainMenu::kContext, {2, 11}, detach);
}

void EditActions::make_add_button() {
  add_button_->setText(tr("Add"));
  add_button_->setToolTip(tr("Add an object to the scene"));
  add_button_->setMenu(&workbench_.menu(MainMenu::kAdd));
  add_button_->setPopupMode(QToolButton::InstantPopup);
  add_button_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  const auto refresh = [this] { add_button_->setIcon(icon("add")); };
  connect(&workbench_, &Workbench::theme_changed, this, refresh);
  refresh();
}

// Other features' buttons go between these.
void EditActions::fill_bar() {
  workbench_.add_to_bar(MainBar::kEditing, {0, 0}, undo);
  workbench_.add_to_bar(MainBar::kEditing, {0, 1}, redo);
  workbench_.add_to_bar(MainBar::kEditing, {0, 10}, add_button_);
  int order = 20;
  for (QAction* action : {duplicate, remove, drop}) {
    workbench_.add_to_bar(MainBar::kEditing, {0, ++order}, action);
  }
  order = 60;
  for (QAction* action : {palm, resize, local}) {
    workbench_.add_to_bar(MainBar::kEditing, {0, ++order}, action);
  }
}

void EditActions::connect_actions() {
  connect(rename, &QAction::triggered, this, [this] { emit rename_requested(); });
  connect(cut, &QAction::triggered, this, [this] {
    copy_objects();
    editor_.remove();
  });
  connect(copy, &QAction::triggered, this, &EditActions::copy_objects);
  connect(paste, &QAction::triggered, this, &EditActions::paste_objects);
  connect(QGuiApplication::clipboard(), &QClipboard::dataChanged, this,
          &EditActions::look_at_clipboard);
  connect(attach, &QAction::triggered, this, [this] { emit attach_requested(); });
  connect(detach, &QAction::triggered, &editor_, &SceneEditor::detach);
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
}

void EditActions::copy_objects() {
  try {
    QGuiApplication::clipboard()->setText(QString::fromStdString(editor_.copied()));
  } catch (const std::exception& error) {
    workbench_.show_error(tr("Nothing was copied"), QString::fromUtf8(error.what()));
  }
}

void EditActions::paste_objects() {
  try {
    editor_.paste(QGuiApplication::clipboard()->text().toStdString());
  } catch (const std::exception& error) {
    workbench_.show_error(tr("The clipboard holds no objects"), QString::fromUtf8(error.what()));
  }
}

void EditActions::fill_add_menu(QMenu& menu) {
  const auto add_shape = [&](const char* name, const QString& title, const QString& object,
                             const geometric::Shape& shape) {
    QAction* action = workbench_.make_action(name, title, {}, {});
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
    QAction* action = workbench_.make_action("object", title, {}, {});
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
  QAction* cloud =
      workbench_.make_action("object", tr("&Point cloud from file…"), {},
                             tr("Add points of a depth camera or a scanner, or a depth image"));
  connect(cloud, &QAction::triggered, this, &EditActions::add_cloud_requested);
  menu.addAction(cloud);
  adding_ << cloud;
  menu.addSeparator();  // what other features add follows
}

void EditActions::take(QAction& action, const QString& name, const QKeySequence& keys,
                       const QString& tip) {
  action.setObjectName(name);
  action.setShortcut(keys);
  action.setStatusTip(tip);
  workbench_.keep_icon(action);
}

void EditActions::look_at_clipboard() {
  // A part `objects`, or a list of objects: their names come first.
  static const QRegularExpression kObjects(
      QStringLiteral(R"((?:^|\n)\s*(?:objects\s*:|-\s*\{?\s*name\s*:))"));
  can_be_pasted_ = kObjects.match(QGuiApplication::clipboard()->text()).hasMatch();
  update_enabled();
}

void EditActions::update_enabled() {
  const geometric::SceneObject* object = editor_.selected_object();
  const bool can_change = editor_.can_change();
  const QString no_scene = editor_.state().scene ? QString() : tr("Open a scene first.");
  const QString no_robot = editor_.document().robot()
                               ? no_scene
                               : tr("The scene has no robot: add one with Add > Robot.");
  const QString no_object = object ? QString() : tr("Select an object first.");
  const QString unchangeable = can_change ? QString()
                               : object   ? tr("The object is locked (Ctrl+L).")
                                          : no_object;
  for (QAction* action : adding_) {
    allow(*action, no_scene);
  }
  add_button_->setEnabled(no_scene.isEmpty());
  allow(*remove,
        editor_.can_remove_robot() || editor_.selected_goal_pose() || editor_.selected_frame()
            ? QString()
            : unchangeable);
  allow(
      *rename,
      !can_change ||
              planning::rigid_parts(*editor_.state().scene, editor_.selected_objects()).size() == 1
          ? unchangeable
          : tr("Select one object, or one group."));
  for (QAction* action : {copy, duplicate, hide, lock}) {
    allow(*action, no_object);
  }
  allow(*cut, unchangeable);
  allow(*paste, can_be_pasted_ ? no_robot : tr("The clipboard holds no objects: copy some first."));
  const bool is_held =
      can_change && std::ranges::any_of(editor_.changeable(), [&](const auto& name) {
        return editor_.state().find(name)->attachment.has_value();
      });
  allow(*attach, is_held      ? tr("The robot holds it already.")
                 : can_change ? no_robot
                              : unchangeable);
  allow(*detach, !can_change || is_held ? unchangeable : tr("The robot does not hold it."));
  allow(*drop, can_change && !editor_.has_several() && object->attachment
                   ? tr("The robot holds it: detach it first.")
                   : unchangeable);
  allow(*palm, no_robot);
  palm->setChecked(editor_.selection().kind == SceneItem::Kind::kPalm);
  hide->setChecked(object && editor_.state().is_hidden(object->name));
  lock->setChecked(object && !can_change);
}

namespace {

constexpr std::array kAxes{"X", "Y", "Z"};

QString axis_name(int axis) { return QLatin1String(kAxes.at(static_cast<std::size_t>(axis))); }

}  // namespace

ArrangeActions::ArrangeActions(Workbench& workbench)
    : workbench_(workbench),
      editor_(workbench.editor),
      align_menu_(new QMenu(tr("&Align"), &workbench.window)),
      distribute_menu_(new QMenu(tr("D&istribute"), &workbench.window)),
      button_(named("arrange", new QToolButton)) {
  select_all =
      workbench_.make_action("select_all", tr("Select &all"),
                             QKeySequence(QStringLiteral("Ctrl+A")), tr("Select every object"));
  array =
      workbench_.make_action("array", tr("Arra&y…"), QKeySequence(QStringLiteral("Ctrl+Shift+A")),
                             tr("Copies in rows or around an axis"));
  group =
      workbench_.make_action("group", tr("&Group"), QKeySequence(QStringLiteral("Ctrl+Shift+G")),
                             tr("Objects of a group are selected and moved together"));
  dissolve = workbench_.make_action("ungroup", tr("&Ungroup"),
                                    QKeySequence(QStringLiteral("Ctrl+Shift+U")),
                                    tr("Make single objects of a group"));
  fill_align_menu();
  fill_distribute_menu();
  place_actions();
  connect(select_all, &QAction::triggered, this, [this] {
    std::vector<std::string> names;
    for (const geometric::SceneObject& object : editor_.state().scene->objects) {
      names.push_back(object.name);
    }
    editor_.select_objects(std::move(names));
  });
  connect(group, &QAction::triggered, this, &ArrangeActions::make_group);
  connect(dissolve, &QAction::triggered, this, &ArrangeActions::ungroup);
  auto* tool = new ArrayTool(editor_, workbench_.view, this);
  connect(array, &QAction::triggered, tool, &ArrayTool::begin);
  connect(&workbench_, &Workbench::theme_changed, this, &ArrangeActions::refresh_icons);
  refresh_icons();
  update_enabled();
}

void ArrangeActions::place_actions() {
  auto* arrange = new QMenu(tr("Arran&ge"), &workbench_.window);
  for (QAction* action :
       {align_menu_->menuAction(), distribute_menu_->menuAction(), array, group, dissolve}) {
    arrange->addAction(action);
  }
  arranging_ = arrange->menuAction();
  int order = 0;
  for (QAction* action : {arranging_, array}) {
    workbench_.add_to_menu(MainMenu::kEdit, {4, ++order}, action);
    workbench_.add_to_menu(MainMenu::kContext, {4, order}, action);
  }
  workbench_.add_to_menu(MainMenu::kEdit, {4, ++order}, select_all);
  button_->setText(tr("Arrange"));
  button_->setToolTip(tr("Align, distribute, repeat or group what is selected"));
  button_->setMenu(arrange);
  button_->setPopupMode(QToolButton::InstantPopup);
  workbench_.add_to_bar(MainBar::kEditing, {0, 70}, button_);
}

void ArrangeActions::fill_align_menu() {
  const std::array<std::pair<planning::AlignTo, QString>, 3> kinds{
      {{planning::AlignTo::kLeast, tr("%1: lower sides")},
       {planning::AlignTo::kCentre, tr("%1: centres")},
       {planning::AlignTo::kMost, tr("%1: upper sides")}}};
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
}

void ArrangeActions::update_enabled() {
  const auto& scene = editor_.state().scene;
  const std::vector<std::string>& objects = editor_.selected_objects();
  const std::size_t parts =
      scene && editor_.can_change() ? planning::rigid_parts(*scene, objects).size() : 0;
  const bool in_group = std::ranges::any_of(objects, [this](const std::string& name) {
    return !editor_.state().display_of(name).group.empty();
  });
  align_menu_->setEnabled(parts > 1);
  distribute_menu_->setEnabled(parts > 2);
  const QString no_object = objects.empty() ? tr("Select an object first.") : QString();
  allow(*array, no_object);
  allow(*group, parts > 1 ? QString() : tr("Select several objects: with Ctrl and a click."));
  allow(*dissolve,
        in_group && editor_.can_change() ? QString() : tr("Select objects of a group first."));
  allow(*select_all, scene && !scene->objects.empty() ? QString() : tr("There are no objects."));
  button_->setEnabled(!objects.empty());
  allow(*arranging_, no_object);
}

void ArrangeActions::align(int axis, planning::AlignTo to) {
  const std::vector<std::string>& objects = editor_.selected_objects();
  planning::SceneState next =
      aligned(editor_.state(), editor_.document().configuration(), objects, axis, to);
  if (next != editor_.state()) {
    editor_.apply(tr("Align %1 along %2").arg(SceneEditor::words_for(objects), axis_name(axis)),
                  std::move(next), objects);
  }
}

void ArrangeActions::distribute(int axis) {
  const std::vector<std::string>& objects = editor_.selected_objects();
  planning::SceneState next =
      distributed(editor_.state(), editor_.document().configuration(), objects, axis);
  if (next != editor_.state()) {
    editor_.apply(
        tr("Distribute %1 along %2").arg(SceneEditor::words_for(objects), axis_name(axis)),
        std::move(next), objects);
  }
}

void ArrangeActions::make_group() {
  const std::vector<std::string> objects = editor_.selected_objects();
  const std::string name =
      planning::unused_group(*editor_.state().scene, tr("group").toStdString());
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
  const std::vector<std::string> members = planning::group_members(*editor_.state().scene, name);
  const std::string unused = planning::unused_group(*editor_.state().scene, new_name);
  editor_.apply(tr("Rename group %1").arg(QString::fromStdString(name)),
                with_changed_display(editor_.state(), members,
                                     [&](auto& display) { display.group = unused; }),
                members);
}

}  // namespace handway::gui
