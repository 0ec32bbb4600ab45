#include "app/menu_commands.h"

#include <QAction>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>

namespace handway::gui {
namespace {

QString plain(QString text) { return text.remove('&').remove(QStringLiteral("…")); }

void add_commands_of(const QMenu& menu, const MenuCommand& parent,
                     std::vector<MenuCommand>& commands) {
  for (QAction* action : menu.actions()) {
    const MenuCommand command{parent.menu, parent.path + plain(action->text()), action};
    if (action->menu()) {
      add_commands_of(*action->menu(), {command.menu, command.path + QStringLiteral(": "), action},
                      commands);
    } else if (!action->isSeparator() && !action->text().isEmpty()) {
      commands.push_back(command);
    }
  }
}

}  // namespace

std::vector<MenuCommand> menu_commands(const QMainWindow& window) {
  std::vector<MenuCommand> commands;
  const auto* bar = window.findChild<QMenuBar*>();
  for (QAction* top : bar ? bar->actions() : QList<QAction*>()) {
    if (top->menu()) {
      add_commands_of(*top->menu(), {plain(top->text()), {}, top}, commands);
    }
  }
  return commands;
}

}  // namespace handway::gui
