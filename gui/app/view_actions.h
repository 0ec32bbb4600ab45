#pragma once

#include <QAction>
#include <QList>
#include <QObject>

class QMainWindow;
class QMenu;

namespace handway::gui {

class SceneView;
class WindowActions;

/// The commands of the 3-D view, in the View menu and on the tool bar: where to look from, and
/// what to show.
class ViewActions : public QObject {
  Q_OBJECT

 public:
  /// All outlive the actions.
  ViewActions(QMainWindow& window, WindowActions& others, SceneView& view);

  /// Draws the icons anew, after a change of theme.
  void refresh_icons();

  QAction* fit;
  QAction* floor;

 private:
  QAction* make(const char* name, const QString& text, const char* keys, const QString& tip);
  void add_standard_views(QMenu& menu);

  QMainWindow& window_;
  SceneView& view_;
  QList<QAction*> on_bar_;
  QList<QAction*> with_icon_;
};

}  // namespace handway::gui
