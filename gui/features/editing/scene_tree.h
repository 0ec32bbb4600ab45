#pragma once

#include "model/document/selection.h"

#include <QTreeWidget>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::gui {

/// Tree of the contents of a scene: robots with their links, objects, start and goal. Objects have
/// boxes that show and hide them, start and goal for their ghosts; an object's name can be edited
/// in place.
class SceneTree : public QTreeWidget {
  Q_OBJECT

 public:
  explicit SceneTree(QWidget* parent = nullptr);

  /// MIME type of data dragged out of the tree: names of objects, one a line.
  static constexpr const char* kDraggedObjects = "application/x-handway-objects";
  [[nodiscard]] static std::vector<std::string> dragged_objects(const QMimeData& data);

  /// Sets the scene; null empties the tree.
  void set_scene(std::shared_ptr<const geometric::Scene> scene);
  /// Shows an edited scene, unfolded as before.
  void update_scene(const planning::SceneState& state);
  /// Begins to edit the name of the object or group that is selected.
  void edit_name();
  /// Selects the item without telling anyone.
  void select(const Selection& selection);
  /// Redraws the icons, after a change of theme.
  void refresh_icons();

 signals:
  /// Emitted with an item that is not an object.
  void item_selected(const handway::gui::SceneItem& item);
  /// Emitted with the objects whose rows, or whose group's rows, are selected; the last one clicked
  /// is the last.
  void objects_selected(const std::vector<std::string>& names);
  /// A double click on start or goal.
  void posture_activated(const handway::gui::SceneItem& item);
  void ghosts_toggled(bool start, bool goal);
  void objects_toggled(const std::vector<std::string>& names, bool shown);
  void object_renamed(const std::string& name, const std::string& new_name);
  void group_renamed(const std::string& name, const std::string& new_name);
  /// Objects were dragged onto a link, a group, an object of a group, or the heading of them all
  /// (kNone).
  void objects_dropped(const std::vector<std::string>& names, const handway::gui::SceneItem& onto);

 protected:
  [[nodiscard]] QMimeData* mimeData(QList<QTreeWidgetItem*> rows) const override;
  [[nodiscard]] QStringList mimeTypes() const override;
  void dragMoveEvent(QDragMoveEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  /// An empty tree says what would be here.
  void paintEvent(QPaintEvent* event) override;

 private:
  void rebuild();
  void take_selection();
  void take_change(QTreeWidgetItem* row);
  void take_object_change(const SceneItem& changed, const std::string& text, bool shown);
  void add_robot(const geometric::RobotInstance& robot);
  /// Rows for mounted parts below `top`, by the composed names of their root links.
  static std::map<std::string, QTreeWidgetItem*> add_parts(const geometric::RobotInstance& robot,
                                                           QTreeWidgetItem& top);
  void add_objects(const geometric::Scene& scene);
  [[nodiscard]] QTreeWidgetItem* object_row(const geometric::SceneObject& object) const;
  [[nodiscard]] QTreeWidgetItem* group_row(const geometric::Scene& scene,
                                           const std::string& group) const;
  void add_frames(const geometric::Scene& scene);
  void add_query(const geometric::Scene& scene);
  [[nodiscard]] SceneItem item_at(const QTreeWidgetItem* row) const;
  /// The objects of these rows, the current one's last.
  [[nodiscard]] std::vector<std::string> objects_of(const QList<QTreeWidgetItem*>& rows) const;
  /// Returns the item onto which dragged objects can be dropped at this position, or nothing.
  [[nodiscard]] std::optional<SceneItem> drop_place(const QPoint& position) const;

  planning::SceneState state_;
  Selection selection_;
};

}  // namespace handway::gui
