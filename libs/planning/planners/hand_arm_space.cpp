#include "planners/hand_arm_space.h"

#include "handway/geometric/robot/normalised_joints.h"

#include <utility>

namespace handway::planning {
namespace {

Eigen::VectorXd arm_of(const PlanningProblem& problem, const Configuration& q) {
  return geometric::normalised(problem.model(), q)(problem.arm);
}

}  // namespace

HandArmSpace::HandArmSpace(const PlanningProblem& problem, sampling::PmdBasis basis)
    : problem_(problem),
      basis_(std::move(basis)),
      corridor_(arm_of(problem, problem.start), arm_of(problem, problem.goal)) {}

Eigen::VectorXd HandArmSpace::coordinates(const Configuration& q) const {
  return geometric::normalised(problem_.model(), q);
}

Configuration HandArmSpace::configuration(const Eigen::VectorXd& coordinates) const {
  return geometric::denormalised(problem_.model(), coordinates);
}

Configuration HandArmSpace::with_arm(const Eigen::VectorXd& arm) const {
  Eigen::VectorXd p = coordinates(problem_.start);
  p(problem_.arm) = arm;
  return configuration(p);
}

Configuration HandArmSpace::with_hand(Configuration q, const Eigen::VectorXd& hand_sample) const {
  const Eigen::VectorXd posture = sampling::map_to_posture(basis_, hand_sample);
  const geometric::RobotModel& model = problem_.model();
  for (std::size_t i = 0; i < problem_.hand.size(); ++i) {
    const int v = problem_.hand[i];
    q[v] = model.lower()[v] +
           posture[static_cast<Eigen::Index>(i)] * (model.upper()[v] - model.lower()[v]);
  }
  return q;
}

sampling::PmdBasis all_hand_joints(const PlanningProblem& problem) {
  std::vector<std::string> joints;
  for (const int v : problem.hand) {
    joints.push_back(problem.model().variable(v).name);
  }
  return sampling::full_joint_basis(problem.model().name(), std::move(joints));
}

}  // namespace handway::planning
