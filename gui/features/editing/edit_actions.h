#pragma once

#include "model/document/scene_editor.h"

#include <QAction>
#include <QList>
#include <QMenu>
#include <QObject>

class QMainWindow;
class QToolBar;
class QToolButton;

namespace handway::gui {

/// The Edit and Add menus and their part of the tool bar.
class EditActions : public QObject {
  Q_OBJECT

 public:
  /// All outlive the actions.
  EditActions(QMainWindow& window, QMenu& edit_menu, QMenu& add_menu, QToolBar& bar,
              SceneEditor& editor);

  /// Draws the icons anew, after a change of theme.
  void refresh_icons();
  /// What can be done with the selection as it is now.
  void update_enabled();

  QAction* undo;
  QAction* redo;
  QAction* rename;
  QAction* duplicate;
  QAction* remove;
  QAction* drop;
  QAction* hide;
  QAction* lock;
  QAction* grasp;   ///< Plans to grasp the selected object.
  QAction* palm;    ///< The palm of the robot is selected, to be moved.
  QAction* resize;  ///< Knobs to make the object larger or smaller.
  QAction* local;   ///< Handles along the object's own axes.

 signals:
  void add_requested(const QString& name, const handway::geometric::Shape& shape);
  /// A mesh of the library, or an empty path to ask for one.
  void add_mesh_requested(const QString& file);
  void rename_requested();

 private:
  QAction* make(const QString& name, const QString& text, const QKeySequence& keys,
                const QString& tip);
  void take(QAction& action, const QString& name, const QKeySequence& keys, const QString& tip);
  void fill_add_menu(QMenu& menu);

  QMainWindow& window_;
  SceneEditor& editor_;
  QToolButton* add_button_;
  QList<QAction*> with_icon_;
  QList<QAction*> adding_;
};

}  // namespace handway::gui
