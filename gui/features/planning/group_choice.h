#pragma once

#include "model/document/scene_editor.h"

#include <QWidget>

#include <string>

class QMenu;
class QPushButton;

namespace handway::gui {

/// Field to choose which joints move: all of the first robot, or some groups, robots and joints. A
/// choice is an edit of the scene that can be undone.
class GroupChoice : public QWidget {
  Q_OBJECT

 public:
  /// @param editor outlives it.
  explicit GroupChoice(SceneEditor& editor, QWidget* parent = nullptr);

 private:
  void show_scene();
  void fill_menu();
  void add_choice(QMenu& menu, const std::string& name);
  void toggle(const std::string& name, bool on);

  SceneEditor& editor_;
  QPushButton* button_;
  QMenu* menu_;
};

}  // namespace handway::gui
