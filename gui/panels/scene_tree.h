#pragma once

#include "handway/geometric/scene/scene.h"
#include "view3d/scene_item.h"

#include <QTreeWidget>

#include <memory>

namespace handway::gui {

/// What a scene holds: robots with their links, objects, start and goal. Start
/// and goal have boxes that show and hide their ghosts.
class SceneTree : public QTreeWidget {
  Q_OBJECT

 public:
  explicit SceneTree(QWidget* parent = nullptr);

  /// Null empties the tree.
  void set_scene(std::shared_ptr<const geometric::Scene> scene);
  /// Selects the item without telling anyone.
  void select(const SceneItem& item);
  /// Draws the icons anew, after a change of theme.
  void refresh_icons();

 signals:
  void item_selected(const handway::gui::SceneItem& item);
  /// A double click on start or goal.
  void posture_activated(const handway::gui::SceneItem& item);
  void ghosts_toggled(bool start, bool goal);

 protected:
  /// An empty tree says what would be here.
  void paintEvent(QPaintEvent* event) override;

 private:
  void add_robot(const geometric::RobotInstance& robot);
  void add_objects(const geometric::Scene& scene);
  void add_query(const geometric::Scene& scene);
  [[nodiscard]] SceneItem item_at(const QTreeWidgetItem* row) const;

  std::shared_ptr<const geometric::Scene> scene_;
};

}  // namespace handway::gui
