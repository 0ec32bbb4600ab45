#include "planners/search_space.h"

#include "handway/geometric/robot/normalised_joints.h"

namespace handway::planning {

SearchSpace::~SearchSpace() = default;

Eigen::VectorXd SearchSpace::coordinates(const Configuration& q) const {
  const Eigen::VectorXd arm = arm_coordinates(q);
  Eigen::VectorXd x(arm.size() + static_cast<Eigen::Index>(problem_.hand.size()));
  x << arm, geometric::normalised(problem_.model(), q)(problem_.hand);
  return x;
}

std::optional<Configuration> SearchSpace::configuration(const Eigen::VectorXd& x,
                                                        const Configuration& reference) const {
  const auto hand_size = static_cast<Eigen::Index>(problem_.hand.size());
  Eigen::VectorXd joints = geometric::normalised(problem_.model(), reference);
  joints(problem_.hand) = x.tail(hand_size);
  return with_arm(geometric::denormalised(problem_.model(), joints), x.head(x.size() - hand_size));
}

Eigen::VectorXd SearchSpace::within_limits(Eigen::VectorXd x) const {
  const auto hand_size = static_cast<Eigen::Index>(problem_.hand.size());
  x.tail(hand_size) = x.tail(hand_size).cwiseMax(0.0).cwiseMin(1.0).eval();
  return x;
}

Eigen::VectorXd SearchSpace::draw(double step, double rho, const Eigen::VectorXd& u,
                                  const Eigen::VectorXd& posture) const {
  const Eigen::VectorXd arm = draw_arm(step, rho, u);
  Eigen::VectorXd x(arm.size() + posture.size());
  x << arm, posture;
  return x;
}

std::unique_ptr<SearchSpace> make_search_space(const PlanningProblem& problem, CorridorForm form) {
  return form == CorridorForm::kCartesian ? make_tool_space(problem) : make_joint_space(problem);
}

}  // namespace handway::planning
