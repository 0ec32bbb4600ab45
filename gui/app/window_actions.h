#pragma once

#include <QAction>
#include <QList>
#include <QString>

class QMainWindow;
class QMenu;
class QToolBar;

namespace handway::gui {

class RecentFiles;

/// The window's commands, in its menus and on its tool bar. What they do is
/// connected by whoever owns the window.
class WindowActions {
 public:
  explicit WindowActions(QMainWindow& window);

  /// Redraws the icons, after a change of theme.
  void refresh_icons();
  /// The menu that shows and hides the side panels.
  [[nodiscard]] QMenu* view_menu() const { return view_menu_; }
  /// Empty, to be filled by those who edit.
  [[nodiscard]] QMenu* edit_menu() const { return edit_menu_; }
  [[nodiscard]] QMenu* add_menu() const { return add_menu_; }
  [[nodiscard]] QToolBar* bar() const { return bar_; }
  [[nodiscard]] QToolBar* edit_bar() const { return edit_bar_; }

  QMenu* create;  ///< File > New: a robot of the library each.
  QAction* open;
  RecentFiles* recent;
  QAction* save;
  QAction* save_as;
  QAction* picture;
  QAction* export_path;
  QAction* pictures;
  QAction* preferences;
  QAction* quit;
  QAction* plan;
  QAction* cancel;
  QAction* optimize;
  QAction* compare;
  QAction* set_start;
  QAction* set_goal;
  QAction* keep_posture;
  QAction* samples;
  QAction* hypercubes;
  QAction* dark;
  QAction* palette;
  QAction* help;
  QAction* about;
  QAction* default_layout;

 private:
  QAction* make(const QString& name, const QString& text, const QKeySequence& keys,
                const QString& tip);

  QMainWindow& window_;
  QMenu* view_menu_;
  QMenu* edit_menu_;
  QMenu* add_menu_;
  QToolBar* bar_;
  QToolBar* edit_bar_;
  QList<QAction*> with_icon_;
};

}  // namespace handway::gui
