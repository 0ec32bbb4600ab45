#pragma once

#include "handway/geometric/robot/numeric_inverse_kinematics.h"
#include "handway/geometric/scene/pose_goal.h"
#include "model/document/selection.h"
#include "model/jobs/background.h"

#include <QObject>

#include <memory>

namespace handway::gui {

class Workbench;

/// Draws the scene's goal poses, and stands the ghost of the goal where inverse kinematics reaches
/// one: while a pose is dragged as near as can be, afterwards where planning goes.
class GoalPoseTool : public QObject {
  Q_OBJECT

 public:
  /// @param workbench outlives the tool.
  explicit GoalPoseTool(Workbench& workbench);

 private:
  void add_command();
  void show();
  /// Shows which poses are reached, and the configuration that planning goes to, once it is known.
  void show_solution();
  void drag(const SceneItem& item, const geometric::Pose& X_WG);
  /// The ghost follows the pose. @returns whether it gets there.
  bool follow(const geometric::PoseGoal& goal, const geometric::Pose& X_WG);

  Workbench& workbench_;
  std::unique_ptr<const geometric::NumericInverseKinematics> ik_;  ///< While one is dragged.
  geometric::Configuration q_;                                     ///< Configuration of the ghost.
  LatestJob job_;
};

}  // namespace handway::gui
