#include "planners/arm_tool.h"

#include "handway/geometric/robot/robot_state.h"

namespace handway::planning {

ArmTool::ArmTool(const PlanningProblem& problem)
    : problem_(problem),
      link_(problem.model().variable_link(problem.arm.back())),
      ik_(geometric::make_tx90_inverse_kinematics(problem.scene->robots.front().model,
                                                  problem.model().link(link_).name)) {}

geometric::Pose ArmTool::pose(const Configuration& q) const {
  geometric::RobotState state(problem_.scene->robots.front().model);
  state.set_configuration(q);
  return state.link_pose(link_);
}

std::optional<Configuration> ArmTool::moved(const Configuration& q,
                                            const geometric::Pose& X_BT) const {
  const geometric::IkResult found = ik_->solve(X_BT, q);
  if (found.solutions.empty()) {
    return std::nullopt;
  }
  return ik_->placed(found.solutions.front(), q);
}

}  // namespace handway::planning
