#include "features/editing/arrange_actions.h"

#include "features/editing/array_tool.h"
#include "model/document/scene_edits.h"
#include "widgets/style/icons.h"
#include "widgets/style/make_action.h"

#include <QMainWindow>
#include <QMenu>
#include <QToolBar>
#include <QToolButton>

#include <algorithm>
#include <array>
#include <utility>

namespace handway::gui {
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
    const geometric::SceneObject* object = editor_.state().find(name);
    return object && !object->group.empty();
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
  editor_.apply(tr("Group %1").arg(SceneEditor::words_for(objects)),
                with_changed_objects(editor_.state(), objects,
                                     [&](geometric::SceneObject& object) { object.group = name; }),
                objects);
}

void ArrangeActions::ungroup() {
  const std::vector<std::string> objects = editor_.selected_objects();
  editor_.apply(tr("Ungroup %1").arg(SceneEditor::words_for(objects)),
                with_changed_objects(editor_.state(), objects,
                                     [](geometric::SceneObject& object) { object.group.clear(); }),
                objects);
}

void ArrangeActions::rename_group(const std::string& name, const std::string& new_name) {
  if (new_name.empty() || new_name == name) {
    return;
  }
  const std::vector<std::string> members = group_members(*editor_.state().scene, name);
  const std::string unused = unused_group(*editor_.state().scene, new_name);
  editor_.apply(
      tr("Rename group %1").arg(QString::fromStdString(name)),
      with_changed_objects(editor_.state(), members,
                           [&](geometric::SceneObject& object) { object.group = unused; }),
      members);
}

}  // namespace handway::gui
