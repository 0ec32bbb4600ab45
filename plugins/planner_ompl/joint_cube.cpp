#include "joint_cube.h"

#include "handway/geometric/robot/normalised_joints.h"

namespace handway::planner_ompl {

using planning::Configuration;

std::vector<int> joints_with_range(const geometric::RobotModel& model) {
  std::vector<int> joints;
  for (int v = 0; v < model.variable_count(); ++v) {
    if (model.upper()[v] > model.lower()[v]) {
      joints.push_back(v);
    }
  }
  return joints;
}

JointCube::JointCube(const planning::PlanningProblem& problem)
    : StateMap(problem), joints_(joints_with_range(problem.model())) {
  const auto size = static_cast<Eigen::Index>(joints_.size());
  make_space(Eigen::VectorXd::Zero(size), Eigen::VectorXd::Ones(size));
}

Eigen::VectorXd JointCube::draw(sampling::RandomStream& stream, std::uint64_t /*sample*/) const {
  return stream.uniform(static_cast<int>(joints_.size()));
}

Eigen::VectorXd JointCube::coordinates(const Configuration& q) const {
  return geometric::normalised(problem().model(), q)(joints_);
}

Configuration JointCube::configuration(const Eigen::VectorXd& x) const {
  Configuration all = Configuration::Zero(problem().model().variable_count());
  all(joints_) = x;
  return geometric::denormalised(problem().model(), all);
}

}  // namespace handway::planner_ompl
