#pragma once

#include "state_map.h"

#include <vector>

namespace handway::planner_ompl {

/// All joints of a problem: a cube [0, 1]^n with one dimension for every joint that has
/// a range. Joints without one stay at their lower limit.
class JointCube final : public StateMap {
 public:
  /// @param problem must outlive this object.
  explicit JointCube(const planning::PlanningProblem& problem);

  /// Uniform over the cube.
  [[nodiscard]] Eigen::VectorXd draw(sampling::RandomStream& stream,
                                     std::uint64_t sample) const override;

 protected:
  [[nodiscard]] Eigen::VectorXd coordinates(const planning::Configuration& q) const override;
  [[nodiscard]] planning::Configuration configuration(const Eigen::VectorXd& x) const override;

 private:
  std::vector<int> joints_;  ///< Variable of each dimension.
};

/// Variables of `model` whose limits are apart.
[[nodiscard]] std::vector<int> joints_with_range(const geometric::RobotModel& model);

}  // namespace handway::planner_ompl
