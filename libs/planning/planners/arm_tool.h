#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/robot/tx90_inverse_kinematics.h"
#include "handway/planning/core/planning_problem.h"

#include <Eigen/Core>

#include <memory>
#include <optional>

namespace handway::planning {

/// The arm of a problem seen from its last link, the tool that carries the hand.
class ArmTool {
 public:
  /// @throws InputError if there is no arm, or it has no closed-form inverse kinematics.
  explicit ArmTool(const PlanningProblem& problem);

  /// X_BT of the tool in the robot's base.
  [[nodiscard]] geometric::Pose pose(const Configuration& q) const;

  /// `q` with the arm moved so that the tool is at X_BT: of all branches the
  /// posture nearest to that of `q`. Nothing if X_BT is out of reach.
  [[nodiscard]] std::optional<Configuration> moved(const Configuration& q,
                                                   const geometric::Pose& X_BT) const;

 private:
  const PlanningProblem& problem_;
  int link_;
  std::unique_ptr<geometric::InverseKinematics> ik_;
};

}  // namespace handway::planning
