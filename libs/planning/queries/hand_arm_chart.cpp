#include "handway/planning/queries/hand_arm_chart.h"

#include "handway/geometric/robot/normalised_joints.h"

namespace handway::planning {

HandArmChart::HandArmChart(const PlanningProblem& problem)
    : problem_(problem),
      axes_{{Axis::Kind::kArmWay, {}}, {Axis::Kind::kArmDistance, {}}},
      arm_start_(geometric::normalised(problem.model(), problem.start)(problem.joints.arm)),
      arm_motion_(geometric::normalised(problem.model(), problem.goal)(problem.joints.arm) -
                  arm_start_) {
  if (!problem_.basis) {
    return;
  }
  const sampling::PmdBasis& basis = *problem_.basis;
  subspace_.emplace(basis);
  for (const sampling::FreeJoint& free : basis.free_joints) {
    axes_.push_back({Axis::Kind::kFreeJoint, basis.joints[static_cast<std::size_t>(free.joint)]});
  }
  for (const sampling::PrincipalDirection& direction : basis.directions) {
    axes_.push_back({Axis::Kind::kDirection, direction.name});
  }
  axes_.push_back({Axis::Kind::kHandDistance, {}});
}

Eigen::VectorXd HandArmChart::at(const Configuration& q) const {
  const Eigen::VectorXd joints = geometric::normalised(problem_.model(), q);
  const Eigen::VectorXd arm = joints(problem_.joints.arm) - arm_start_;
  const double length = arm_motion_.squaredNorm();
  Eigen::VectorXd result(static_cast<Eigen::Index>(axes_.size()));
  result[0] = length > 0.0 ? arm.dot(arm_motion_) / length : 0.0;
  result[1] = (arm - result[0] * arm_motion_).norm();
  if (subspace_) {
    const Eigen::VectorXd hand = joints(problem_.joints.hand);
    result.segment(2, problem_.basis->dimension()) = sampling::project(*problem_.basis, hand);
    result[result.size() - 1] = subspace_->distance(hand);
  }
  return result;
}

}  // namespace handway::planning
