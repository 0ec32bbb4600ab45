#pragma once

#include "model/document/arrange.h"
#include "model/document/scene_editor.h"

#include <QAction>
#include <QList>
#include <QObject>

#include <string>
#include <vector>

class QMainWindow;
class QMenu;
class QToolBar;
class QToolButton;

namespace handway::gui {

class SceneView;

/// The commands for several objects at once, in the Edit menu and behind a button
/// of the tool bar: align, distribute, array, group.
class ArrangeActions : public QObject {
  Q_OBJECT

 public:
  /// All outlive the actions.
  ArrangeActions(QMainWindow& window, QMenu& edit_menu, QToolBar& bar, SceneEditor& editor,
                 SceneView& view);

  /// Draws the icons anew, after a change of theme.
  void refresh_icons();
  /// What can be done with the selection as it is now.
  void update_enabled();

  void align(int axis, AlignTo to);
  void distribute(int axis);
  void make_group();
  void ungroup();
  void rename_group(const std::string& name, const std::string& new_name);

  QAction* select_all;
  QAction* array;
  QAction* group;
  QAction* dissolve;

 private:
  void fill_align_menu();
  void fill_distribute_menu();
  QAction* make(const char* name, const QString& text, const char* keys, const QString& tip);

  QMainWindow& window_;
  SceneEditor& editor_;
  QMenu* align_menu_;
  QMenu* distribute_menu_;
  QToolButton* button_;
  QList<QAction*> with_icon_;
};

}  // namespace handway::gui
