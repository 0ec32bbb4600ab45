#pragma once

#include <QMainWindow>

#include <initializer_list>

class QMenu;
class QUndoView;

namespace handway::gui {

/// What goes into the docks around the view.
struct DockContents {
  QWidget* scene;
  QWidget* properties;
  QWidget* messages;
  QUndoView* history;
  QWidget* plan;
  QWidget* joints;
  QWidget* hand;
  QWidget* glove;
};

/// Docks at their usual places; the history is hidden at first.
/// @param view_menu, edit_menu get actions that show and hide them.
void build_docks(QMainWindow& window, const DockContents& contents, QMenu& view_menu,
                 QMenu& edit_menu);

/// Widgets above each other without gaps. @param stretched index of the one that takes the rest.
[[nodiscard]] QWidget* stacked(std::initializer_list<QWidget*> parts, int stretched);

/// Which docks are where, kept between runs.
void save_layout(const QMainWindow& window);
/// @returns false if there is none, or one of another version of the program.
bool restore_layout(QMainWindow& window);

}  // namespace handway::gui
