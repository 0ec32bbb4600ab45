#pragma once

#include "handway/planning/edits/arranging.h"
#include "model/document/scene_editor.h"

#include <QAction>
#include <QList>
#include <QMenu>
#include <QObject>

#include <string>
#include <vector>

class QMenu;
class QToolButton;

namespace handway::gui {

class Workbench;

/// The Edit and Add menus and their part of the tool bar.
class EditActions : public QObject {
  Q_OBJECT

 public:
  /// @param workbench outlives the actions.
  explicit EditActions(Workbench& workbench);

  /// Enables the commands that apply to the present selection.
  void update_enabled();

  QAction* undo;
  QAction* redo;
  QAction* rename;
  QAction* cut;
  QAction* copy;
  QAction* paste;
  QAction* duplicate;
  QAction* remove;
  QAction* drop;
  QAction* hide;
  QAction* lock;
  QAction* palm;    ///< The palm of the robot is selected, to be moved.
  QAction* resize;  ///< Knobs to make the object larger or smaller.
  QAction* local;   ///< Handles along the object's own axes.
  QAction* attach;  ///< To the palm.
  QAction* detach;

 signals:
  void add_requested(const QString& name, const handway::geometric::Shape& shape);
  /// A mesh of the library, or an empty path to ask for one.
  void add_mesh_requested(const QString& file);
  void add_cloud_requested();
  void rename_requested();
  void attach_requested();

 private:
  void make_actions();
  void make_add_button();
  void fill_menu();
  void fill_bar();
  void connect_actions();
  void copy_objects();
  void paste_objects();
  void look_at_clipboard();
  void take(QAction& action, const QString& name, const QKeySequence& keys, const QString& tip);
  void fill_add_menu(QMenu& menu);

  Workbench& workbench_;
  SceneEditor& editor_;
  QToolButton* add_button_;
  QList<QAction*> adding_;
  bool can_be_pasted_ = false;  ///< True if the clipboard holds objects.
};

/// The commands for several objects at once, in the Edit menu and behind a button
/// of the tool bar: align, distribute, array, group.
class ArrangeActions : public QObject {
  Q_OBJECT

 public:
  /// @param workbench outlives the actions.
  explicit ArrangeActions(Workbench& workbench);

  /// Enables the commands that apply to the present selection.
  void update_enabled();

  void align(int axis, planning::AlignTo to);
  void distribute(int axis);
  void make_group();
  void ungroup();
  void rename_group(const std::string& name, const std::string& new_name);

  QAction* select_all;
  QAction* array;
  QAction* group;
  QAction* dissolve;

 private:
  void refresh_icons();
  void fill_align_menu();
  void fill_distribute_menu();
  void place_actions();

  Workbench& workbench_;
  SceneEditor& editor_;
  QMenu* align_menu_;
  QMenu* distribute_menu_;
  QAction* arranging_ = nullptr;  ///< The menu of them all.
  QToolButton* button_;
};

}  // namespace handway::gui
