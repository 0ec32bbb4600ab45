#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/planners/corridor_form.h"
#include "handway/planning/planners/hand_space.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "planners/search_space.h"

#include <Eigen/Core>

#include <memory>
#include <optional>

namespace handway::planning {

/// Composes configurations of hand and arm from samples of their regions
/// (paper, section 5.1).
class HandArmSpace {
 public:
  /// @param basis the hand's axes; @param problem must outlive this object.
  /// @throws InputError as make_tool_space().
  HandArmSpace(const PlanningProblem& problem, sampling::PmdBasis basis, CorridorForm form);

  [[nodiscard]] const sampling::PmdBasis& basis() const { return basis_; }
  /// Hypercubes of half side `rho` that the corridor is cut into, less one.
  [[nodiscard]] int steps(double rho) const { return arm_space_->steps(rho); }
  /// Coordinates of an arm sample.
  [[nodiscard]] int arm_draws() const { return arm_space_->arm_draws(); }

  /// Joints normalised to [0, 1]: the coordinates of distances.
  [[nodiscard]] Eigen::VectorXd coordinates(const Configuration& q) const;

  /// c_a from the hypercube at `step`, with the hand as at the start; nothing if
  /// the drawn tool pose is out of reach. Among several arm postures the one
  /// nearest to the straight motion is taken. @param u in [0,1]^arm_draws().
  [[nodiscard]] std::optional<Configuration> arm_sample(double step, double rho,
                                                        const Eigen::VectorXd& u) const;

  /// (c_a, MAP(sc_h)): `q` with the hand at the posture of `hand_sample` in [0,1]^k.
  [[nodiscard]] Configuration with_hand(Configuration q, const Eigen::VectorXd& hand_sample) const;

 private:
  const PlanningProblem& problem_;
  sampling::PmdBasis basis_;
  std::unique_ptr<SearchSpace> arm_space_;
};

/// The axes of `space`: those of the problem's basis, or, as where it has none, every hand joint on
/// its own.
[[nodiscard]] sampling::PmdBasis hand_basis(const PlanningProblem& problem, HandSpace space);

}  // namespace handway::planning
