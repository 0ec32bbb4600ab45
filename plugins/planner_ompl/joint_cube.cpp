#include "joint_cube.h"

#include "handway/geometric/robot/normalised_joints.h"

namespace handway::planner_ompl {
namespace {

using planning::Configuration;
using RealState = ompl::base::RealVectorStateSpace::StateType;

std::vector<int> joints_with_range(const geometric::RobotModel& model) {
  std::vector<int> joints;
  for (int v = 0; v < model.variable_count(); ++v) {
    if (model.upper()[v] > model.lower()[v]) {
      joints.push_back(v);
    }
  }
  return joints;
}

}  // namespace

JointCube::JointCube(const planning::PlanningProblem& problem)
    : problem_(problem),
      joints_(joints_with_range(problem.model())),
      start_(coordinates(problem.start)),
      goal_(coordinates(problem.goal)),
      space_(std::make_shared<ompl::base::RealVectorStateSpace>(
          static_cast<unsigned int>(joints_.size()))) {
  space_->setBounds(0.0, 1.0);
}

Eigen::VectorXd JointCube::coordinates(const Configuration& q) const {
  const Configuration all = geometric::normalised(problem_.model(), q);
  return all(joints_).cwiseMax(0.0).cwiseMin(1.0);
}

void JointCube::write(const Configuration& q, ompl::base::State* state) const {
  Eigen::Map<Eigen::VectorXd>(state->as<RealState>()->values,
                              static_cast<Eigen::Index>(joints_.size())) = coordinates(q);
}

Configuration JointCube::read(const ompl::base::State* state) const {
  const Eigen::Map<const Eigen::VectorXd> values(state->as<RealState>()->values,
                                                 static_cast<Eigen::Index>(joints_.size()));
  if (values == start_) {
    return problem_.start;
  }
  if (values == goal_) {
    return problem_.goal;
  }
  Configuration all = Configuration::Zero(problem_.model().variable_count());
  all(joints_) = values;
  return geometric::denormalised(problem_.model(), all);
}

}  // namespace handway::planner_ompl
