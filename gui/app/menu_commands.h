#pragma once

#include <QString>

#include <vector>

class QAction;
class QMainWindow;

namespace handway::gui {

/// A command in the menus of a window.
struct MenuCommand {
  QString menu;  ///< "View", without the mark of its key.
  QString path;  ///< "Standard views: Top", within that menu.
  QAction* action;
};

/// Returns all commands of the menu bar, in its order.
[[nodiscard]] std::vector<MenuCommand> menu_commands(const QMainWindow& window);

}  // namespace handway::gui
