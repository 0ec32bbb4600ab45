#pragma once

#include <QAction>
#include <QList>
#include <QString>

class QMainWindow;
class QMenu;

namespace handway::gui {

class RecentFiles;

/// The window's commands, in its menus and on its tool bar. What they do is
/// connected by whoever owns the window.
class WindowActions {
 public:
  explicit WindowActions(QMainWindow& window);

  /// Draws the icons anew, after a change of theme.
  void refresh_icons();
  /// The menu that shows and hides the side panels.
  [[nodiscard]] QMenu* view_menu() const { return view_menu_; }

  QAction* open;
  RecentFiles* recent;
  QAction* save_as;
  QAction* picture;
  QAction* quit;
  QAction* plan;
  QAction* cancel;
  QAction* fit;
  QAction* oblique;
  QAction* front;
  QAction* left;
  QAction* top;
  QAction* floor;
  QAction* samples;
  QAction* dark;
  QAction* about;

 private:
  QAction* make(const QString& name, const QString& text, const QKeySequence& keys,
                const QString& tip);

  QMainWindow& window_;
  QMenu* view_menu_;
  QList<QAction*> with_icon_;
};

}  // namespace handway::gui
