#include "planners/arm_tool.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/robot_state.h"

#include <algorithm>

namespace handway::planning {
namespace {

[[noreturn]] void refuse(const PlanningProblem& problem, const std::string& found) {
  throw geometric::InputError({problem.scene->file.string(), "robot " + problem.model().name(),
                               found, "an arm built like the TX90, to plan in tool poses",
                               "Set corridor to joint, or choose another planner"});
}

int last_arm_link(const PlanningProblem& problem) {
  if (problem.arm.empty()) {
    refuse(problem, "no arm: all its joints are of the hand");
  }
  return problem.model().variable_link(*std::ranges::max_element(problem.arm));
}

}  // namespace

ArmTool::ArmTool(const PlanningProblem& problem)
    : problem_(problem),
      link_(last_arm_link(problem)),
      ik_(geometric::make_tx90_inverse_kinematics(problem.scene->robots.front().model,
                                                  problem.model().link(link_).name)) {
  std::vector<int> arm = problem.arm;
  std::ranges::sort(arm);
  if (ik_->variables() != arm) {
    refuse(problem, "an arm of other joints than those before its last link");
  }
}

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
