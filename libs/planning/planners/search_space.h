#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/planners/corridor_form.h"

#include <Eigen/Core>

#include <memory>
#include <optional>

namespace handway::planning {

/// Coordinates in which the arm is drawn from its corridor and trees grow:
/// distances are Euclidean in them, a step goes along a straight line of them.
/// First those of the arm, then the hand's joints normalised to [0, 1].
class SearchSpace {
 public:
  virtual ~SearchSpace();
  SearchSpace(const SearchSpace&) = delete;
  SearchSpace& operator=(const SearchSpace&) = delete;

  /// Hypercubes of half side `rho` that the arm's corridor is cut into, less one.
  [[nodiscard]] virtual int steps(double rho) const = 0;
  /// Unit-cube coordinates that draw_arm() takes.
  [[nodiscard]] virtual int arm_draws() const = 0;
  [[nodiscard]] Eigen::VectorXd coordinates(const Configuration& q) const;
  /// The configuration at `x`, nearest to `reference` where there are several;
  /// nothing if the arm can't reach it.
  [[nodiscard]] std::optional<Configuration> configuration(const Eigen::VectorXd& x,
                                                           const Configuration& reference) const;
  /// The coordinates of joints cut off at their limits.
  [[nodiscard]] virtual Eigen::VectorXd within_limits(Eigen::VectorXd x) const;
  /// Coordinates whose arm is drawn from the corridor at `step` with half-width
  /// `rho` (@p u in [0,1]^arm_draws()), the hand at normalised `posture`.
  [[nodiscard]] Eigen::VectorXd draw(double step, double rho, const Eigen::VectorXd& u,
                                     const Eigen::VectorXd& posture) const;

 protected:
  explicit SearchSpace(const PlanningProblem& problem) : problem_(problem) {}

  [[nodiscard]] const PlanningProblem& problem() const { return problem_; }

  [[nodiscard]] virtual Eigen::VectorXd arm_coordinates(const Configuration& q) const = 0;
  /// `q`, with its hand posture, with the arm at `x`.
  [[nodiscard]] virtual std::optional<Configuration> with_arm(const Configuration& q,
                                                              const Eigen::VectorXd& x) const = 0;
  [[nodiscard]] virtual Eigen::VectorXd draw_arm(double step, double rho,
                                                 const Eigen::VectorXd& u) const = 0;

 private:
  const PlanningProblem& problem_;
};

/// Arm coordinates are its joints normalised to [0, 1].
[[nodiscard]] std::unique_ptr<SearchSpace> make_joint_space(const PlanningProblem& problem);

/// Arm coordinates are the pose of the last arm link: position and rotation
/// vector in units of CartesianScale.
/// @throws InputError if the arm has no closed-form inverse kinematics.
[[nodiscard]] std::unique_ptr<SearchSpace> make_tool_space(const PlanningProblem& problem);

/// @throws InputError as make_tool_space().
[[nodiscard]] std::unique_ptr<SearchSpace> make_search_space(const PlanningProblem& problem,
                                                             CorridorForm form);

}  // namespace handway::planning
