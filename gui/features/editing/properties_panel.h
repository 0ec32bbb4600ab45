#pragma once

#include "model/document/scene_editor.h"
#include "widgets/panels/dock_layout.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QToolButton;

namespace handway::gui {

class ConstraintForm;
class GoalPoseForm;
class PoseForm;
class ShapeForm;

/// Panel with the properties of the selection as numbers that can be edited.
class PropertiesPanel : public PanelArea {
  Q_OBJECT

 public:
  /// @param editor outlives the panel.
  explicit PropertiesPanel(SceneEditor& editor, QWidget* parent = nullptr);

  /// Shows the selection as it is now.
  void refresh();
  /// Shows where the selection is being dragged to.
  void preview_pose(const geometric::Pose& X_WO);
  /// Redraws the icons, after a change of theme.
  void refresh_icons();

 signals:
  /// Other cells were typed for the selected point cloud.
  void cells_edited(const handway::geometric::CloudCells& cells);
  /// Emitted to attach the selected object to a link; both empty: to the world.
  void attach_requested(const std::string& robot, const std::string& link);
  /// Emitted to mount the selected robot on a link; nothing: to place it in the world.
  void mount_requested(const std::string& robot,
                       const std::optional<handway::planning::LinkOfRobot>& on);

 private:
  QWidget* make_header();
  void show_object(const geometric::SceneObject& object);
  void show_objects(const geometric::SceneObject& last);
  void show_common(const geometric::SceneObject& object, bool editable);
  void show_robot(const std::string& robot);
  void list_mounts(const std::string& robot);
  void show_link(const geometric::RobotInstance& robot);
  void show_posture(const geometric::Pose& X_WP);
  void show_goal_pose(const geometric::PoseGoal& goal);
  void show_frame(const geometric::NamedFrame& frame);
  void show_hint();
  void show_parts(bool header, bool pose, bool shape);
  void show_constraints();
  void connect_constraints();
  void list_parents(const geometric::SceneObject& object);
  void choose_color();
  void paint_swatch(const geometric::Color& color);

  SceneEditor& editor_;
  Selection shown_;
  QLabel* hint_;
  QWidget* header_;
  QLineEdit* name_;
  QLabel* kind_;
  QToolButton* lock_;
  QToolButton* hide_;
  QWidget* pose_box_;
  QLabel* pose_title_;
  PoseForm* pose_;
  geometric::Pose X_WF_ = geometric::Pose::Identity();  ///< Pose of the shown frame.
  GoalPoseForm* goal_form_;
  QWidget* frame_box_;
  QComboBox* frame_parent_;
  QWidget* mount_box_;
  QComboBox* mount_;
  QWidget* shape_box_;
  ShapeForm* shape_;
  QLabel* extent_;
  QToolButton* color_;
  QComboBox* parent_;
  QCheckBox* solid_;
  QWidget* constraints_box_;
  ConstraintForm* constraints_;
};

}  // namespace handway::gui
