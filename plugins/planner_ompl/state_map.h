#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Core>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <cstdint>
#include <memory>

namespace handway::planner_ompl {

class Draws;

/// What OMPL's states stand for: configurations of a problem, as points of a box of
/// real numbers. Distances are Euclidean there, motions straight lines.
class StateMap {
 public:
  virtual ~StateMap();
  StateMap(const StateMap&) = delete;
  StateMap& operator=(const StateMap&) = delete;

  [[nodiscard]] const std::shared_ptr<ompl::base::RealVectorStateSpace>& space() const {
    return space_;
  }

  /// Makes every sampler of space() draw what draw() says, with seeds and counts of
  /// `draws`, which must outlive the space. @pre before samplers are made.
  void draw_from(Draws& draws);

  /// Writes the coordinates of `q`, moved into the box.
  void write(const planning::Configuration& q, ompl::base::State* state) const;

  /// The configuration at `state`, within limits. What was written for the problem's
  /// start or goal is read as that very configuration, to the bit.
  [[nodiscard]] planning::Configuration read(const ompl::base::State* state) const;

  /// Coordinates of a random state. @param sample those drawn before.
  [[nodiscard]] virtual Eigen::VectorXd draw(sampling::RandomStream& stream,
                                             std::uint64_t sample) const = 0;

 protected:
  /// @param problem must outlive this object.
  explicit StateMap(const planning::PlanningProblem& problem) : problem_(problem) {}

  /// To be called by the derived constructor, once its coordinates() works.
  /// @param lower, upper corners of the box, of the same size, the first below the second.
  void make_space(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

  [[nodiscard]] const planning::PlanningProblem& problem() const { return problem_; }

  /// Coordinates of `q`, in the box but for roundings.
  [[nodiscard]] virtual Eigen::VectorXd coordinates(const planning::Configuration& q) const = 0;
  [[nodiscard]] virtual planning::Configuration configuration(const Eigen::VectorXd& x) const = 0;

 private:
  const planning::PlanningProblem& problem_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  Eigen::VectorXd start_;
  Eigen::VectorXd goal_;
  std::shared_ptr<ompl::base::RealVectorStateSpace> space_;
};

}  // namespace handway::planner_ompl
