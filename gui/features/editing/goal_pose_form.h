#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/scene/pose_goal.h"
#include "handway/geometric/scene/scene.h"

#include <QWidget>

#include <array>

class QCheckBox;
class QComboBox;
class QToolButton;

namespace handway::gui {

class PoseForm;
class QuantityField;

/// Form of a goal pose: its link, the object that it moves with, the tool frame in the link, and
/// its tolerances.
class GoalPoseForm : public QWidget {
  Q_OBJECT

 public:
  explicit GoalPoseForm(QWidget* parent = nullptr);

  /// @param scene has the goal.
  void show_goal(const geometric::Scene& scene, const geometric::PoseGoal& goal);

 signals:
  /// Emitted after the user has changed the goal. Its pose is exactly the one that was shown.
  void goal_edited(const handway::geometric::PoseGoal& goal);

 private:
  void connect_fields();
  /// Shows the object and the tool in the link.
  void unfold(bool on);
  /// Sets the tolerance of the axes that are not free.
  void set_rotation(double tolerance);
  void list_links(const geometric::RobotModel& model);
  void list_objects(const geometric::Scene& scene);

  geometric::PoseGoal goal_;
  QComboBox* link_;
  QComboBox* object_;
  QuantityField* position_;
  QuantityField* rotation_;
  std::array<QCheckBox*, 3> free_;  ///< About x, y and z.
  QToolButton* fold_;
  QWidget* more_;  ///< Hidden when it is folded.
  PoseForm* tool_;
};

}  // namespace handway::gui
