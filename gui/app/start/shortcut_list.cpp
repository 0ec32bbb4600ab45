#include "app/start/shortcut_list.h"

#include "app/menu_commands.h"
#include "widgets/forms/arrangement.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/style/theme.h"

#include <QAction>
#include <QCoreApplication>
#include <QDialog>
#include <QHeaderView>
#include <QLineEdit>
#include <QMainWindow>
#include <QTreeWidget>

namespace handway::gui {
namespace {

struct Key {
  const char* command;
  const char* keys;
};

/// Keys that no menu shows.
constexpr Key kOtherKeys[] = {
    {QT_TRANSLATE_NOOP("Shortcuts", "Next pane, previous pane"), "F6, Shift+F6"},
    {QT_TRANSLATE_NOOP("Shortcuts", "Play, pause"), "Space"},
    {QT_TRANSLATE_NOOP("Shortcuts", "Previous waypoint, next waypoint"), "[, ]"},
    {QT_TRANSLATE_NOOP("Shortcuts", "Previous frame, next frame"), "comma, point"},
    {QT_TRANSLATE_NOOP("Shortcuts", "During a drag: snap to 10 mm and 15°"), "Ctrl"},
    {QT_TRANSLATE_NOOP("Shortcuts", "During a drag: snap to sides of other objects"), "Shift"},
    {QT_TRANSLATE_NOOP("Shortcuts", "During a drag: type a distance, then the next axis"),
     "digits, Tab"},
    {QT_TRANSLATE_NOOP("Shortcuts", "During a drag: finish, cancel"), "Enter, Esc"}};

QTreeWidgetItem* add_group(QTreeWidget& tree, const QString& title) {
  auto* group = new QTreeWidgetItem(&tree, {title});
  QFont bold = tree.font();
  bold.setBold(true);
  group->setFont(0, bold);
  group->setFlags(Qt::ItemIsEnabled);
  return group;
}

void fill(QTreeWidget& tree, const QMainWindow& window) {
  QTreeWidgetItem* group = nullptr;
  for (const MenuCommand& command : menu_commands(window)) {
    const QString keys = command.action->shortcut().toString(QKeySequence::NativeText);
    if (keys.isEmpty()) {
      continue;
    }
    if (!group || group->text(0) != command.menu) {
      group = add_group(tree, command.menu);
    }
    new QTreeWidgetItem(group, {command.path, keys});
  }
  group = add_group(tree, QObject::tr("View and playback"));
  for (const Key& key : kOtherKeys) {
    new QTreeWidgetItem(group, {QCoreApplication::translate("Shortcuts", key.command),
                                QString::fromUtf8(key.keys)});
  }
  tree.expandAll();
}

// Rows without the text in one of their columns are hidden, and so are groups without rows.
void find_in(QTreeWidget& tree, const QString& text) {
  for (int i = 0; i < tree.topLevelItemCount(); ++i) {
    QTreeWidgetItem& group = *tree.topLevelItem(i);
    bool has_rows = false;
    for (int j = 0; j < group.childCount(); ++j) {
      QTreeWidgetItem& row = *group.child(j);
      const bool found = row.text(0).contains(text, Qt::CaseInsensitive) ||
                         row.text(1).contains(text, Qt::CaseInsensitive);
      row.setHidden(!found);
      has_rows |= found;
    }
    group.setHidden(!has_rows);
  }
}

}  // namespace

void show_shortcuts(QMainWindow& window) {
  auto* dialog = named("shortcuts", new QDialog(&window));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(QObject::tr("Keyboard shortcuts"));
  auto* field = named("shortcuts_find", new QLineEdit);
  field->setPlaceholderText(QObject::tr("Find a command or a key"));
  field->setClearButtonEnabled(true);
  auto* tree = named("shortcuts_list", new QTreeWidget);
  tree->setColumnCount(2);
  tree->setHeaderHidden(true);
  tree->setRootIsDecorated(false);
  tree->setSelectionMode(QAbstractItemView::NoSelection);
  tree->setAccessibleName(QObject::tr("Keyboard shortcuts"));
  fill(*tree, window);
  tree->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  tree->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  tree->header()->setStretchLastSection(false);
  QObject::connect(field, &QLineEdit::textChanged, tree,
                   [tree](const QString& text) { find_in(*tree, text); });
  lay_out(*dialog, in_column({field, {tree, 1}}, 8), {12, 12, 12, 12});
  dialog->resize(within_window(*dialog, {scaled(520), scaled(640)}));
  dialog->show();
  field->setFocus();
}

}  // namespace handway::gui
