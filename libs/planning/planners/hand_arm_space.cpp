#include "planners/hand_arm_space.h"

#include "handway/geometric/robot/normalised_joints.h"

#include <utility>

namespace handway::planning {

HandArmSpace::HandArmSpace(const PlanningProblem& problem, sampling::PmdBasis basis,
                           CorridorForm form)
    : problem_(problem), basis_(std::move(basis)), arm_space_(make_search_space(problem, form)) {}

Eigen::VectorXd HandArmSpace::coordinates(const Configuration& q) const {
  return geometric::normalised(problem_.model(), q);
}

std::optional<Configuration> HandArmSpace::arm_sample(double step, double rho,
                                                      const Eigen::VectorXd& u) const {
  Configuration on_segment = problem_.start;
  on_segment(problem_.arm) += step * (problem_.goal - problem_.start)(problem_.arm);
  const Eigen::VectorXd hand_at_start = coordinates(problem_.start)(problem_.hand);
  return arm_space_->configuration(arm_space_->draw(step, rho, u, hand_at_start), on_segment);
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

sampling::PmdBasis hand_basis(const PlanningProblem& problem, HandSpace space) {
  if (space == HandSpace::kPrincipalDirections && problem.basis) {
    return *problem.basis;
  }
  std::vector<std::string> joints;
  joints.reserve(problem.hand.size());
  for (const int v : problem.hand) {
    joints.push_back(problem.model().variable(v).name);
  }
  return sampling::full_joint_basis(problem.model().name(), std::move(joints));
}

}  // namespace handway::planning
