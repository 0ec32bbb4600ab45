#include "features/editing/edit_actions.h"

#include "handway/geometric/io/resources.h"
#include "model/document/selection.h"
#include "widgets/style/icons.h"
#include "widgets/style/make_action.h"

#include <QMainWindow>
#include <QToolBar>
#include <QToolButton>

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
  hide->setChecked(object && object->hidden);
  lock->setChecked(object && !can_change);
}

}  // namespace handway::gui
