#include "handway/planning/spaces/hand_arm_region.h"

#include "handway/geometric/robot/normalised_joints.h"

#include <utility>

namespace handway::planning {
namespace {

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

}  // namespace

HandArmRegion::HandArmRegion(const PlanningProblem& problem, HandSpace hand, CorridorForm form)
    : problem_(problem),
      basis_(hand_basis(problem, hand)),
      space_(make_corridor_space(problem, form)) {}

std::optional<Configuration> HandArmRegion::arm_at(double step, double rho,
                                                   const Eigen::VectorXd& u) const {
  Configuration on_segment = problem_.start;
  on_segment(problem_.arm) += step * (problem_.goal - problem_.start)(problem_.arm);
  const Eigen::VectorXd arm = space_->corridor_point(step, rho, u);
  const Eigen::VectorXd hand =
      geometric::normalised(problem_.model(), problem_.start)(problem_.hand);
  Eigen::VectorXd x(arm.size() + hand.size());
  x << arm, hand;
  return space_->configuration(x, on_segment);
}

Configuration HandArmRegion::with_hand(Configuration q, const Eigen::VectorXd& u) const {
  const Eigen::VectorXd posture = sampling::map_to_posture(basis_, u);
  const geometric::RobotModel& model = problem_.model();
  for (std::size_t i = 0; i < problem_.hand.size(); ++i) {
    const int v = problem_.hand[i];
    q[v] = model.lower()[v] +
           posture[static_cast<Eigen::Index>(i)] * (model.upper()[v] - model.lower()[v]);
  }
  return q;
}

}  // namespace handway::planning
