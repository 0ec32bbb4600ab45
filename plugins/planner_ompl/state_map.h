#pragma once

#include "handway/planning/spaces/state_space.h"

#include <Eigen/Core>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <memory>
#include <vector>

namespace handway::planner_ompl {

/// OMPL's states as points of one of Handway's state spaces. Coordinates without extent are left
/// out: OMPL accepts none.
class StateMap {
 public:
  explicit StateMap(std::unique_ptr<planning::StateSpace> coordinates);

  [[nodiscard]] const std::shared_ptr<ompl::base::RealVectorStateSpace>& space() const {
    return space_;
  }
  [[nodiscard]] const planning::PlanningProblem& problem() const { return coordinates_->problem(); }

  /// Writes the coordinates of `q`, moved into the space's box.
  void write(const planning::Configuration& q, ompl::base::State* state) const;

  /// The configuration at `state`, within limits. States of the problem's start or goal give
  /// bitwise those configurations.
  [[nodiscard]] planning::Configuration read(const ompl::base::State* state) const;

 private:
  [[nodiscard]] Eigen::VectorXd values_of(const planning::Configuration& q) const;

  std::unique_ptr<planning::StateSpace> coordinates_;
  std::vector<int> kept_;  ///< Coordinates with an extent.
  Eigen::VectorXd start_;
  Eigen::VectorXd goal_;
  std::shared_ptr<ompl::base::RealVectorStateSpace> space_;
};

}  // namespace handway::planner_ompl
