#pragma once

#include "handway/planning/core/planning_problem.h"

#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <memory>
#include <vector>

namespace handway::planner_ompl {

/// The joints of a problem as OMPL sees them: a cube [0, 1]^n with one dimension for
/// every joint that has a range. Joints without one stay at their lower limit.
class JointCube {
 public:
  /// @param problem must outlive this object.
  explicit JointCube(const planning::PlanningProblem& problem);

  [[nodiscard]] const std::shared_ptr<ompl::base::RealVectorStateSpace>& space() const {
    return space_;
  }

  /// Writes the coordinates of `q`, those beyond a limit by roundings moved onto it.
  void write(const planning::Configuration& q, ompl::base::State* state) const;

  /// The configuration at `state`. What was written for the problem's start or goal
  /// is read as that very configuration, to the bit.
  [[nodiscard]] planning::Configuration read(const ompl::base::State* state) const;

 private:
  [[nodiscard]] Eigen::VectorXd coordinates(const planning::Configuration& q) const;

  const planning::PlanningProblem& problem_;
  std::vector<int> joints_;  ///< Variable of each dimension.
  Eigen::VectorXd start_;
  Eigen::VectorXd goal_;
  std::shared_ptr<ompl::base::RealVectorStateSpace> space_;
};

}  // namespace handway::planner_ompl
