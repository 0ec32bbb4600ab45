#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/regions/arm_corridor.h"

#include <Eigen/Core>

namespace handway::planning {

/// Composes configurations of hand and arm from samples of their regions
/// (paper, section 5.1).
class HandArmSpace {
 public:
  /// @param basis the hand's axes; @param problem must outlive this object.
  HandArmSpace(const PlanningProblem& problem, sampling::PmdBasis basis);

  [[nodiscard]] const sampling::ArmCorridor& corridor() const { return corridor_; }
  [[nodiscard]] const sampling::PmdBasis& basis() const { return basis_; }
  [[nodiscard]] int arm_dimension() const { return static_cast<int>(problem_.arm.size()); }

  /// Joints normalised to [0, 1]: the coordinates of distances.
  [[nodiscard]] Eigen::VectorXd coordinates(const Configuration& q) const;
  [[nodiscard]] Configuration configuration(const Eigen::VectorXd& coordinates) const;

  /// The start with the arm at normalised `arm`.
  [[nodiscard]] Configuration with_arm(const Eigen::VectorXd& arm) const;

  /// (c_a, MAP(sc_h)): `q` with the hand at the posture of `hand_sample` in [0,1]^k.
  [[nodiscard]] Configuration with_hand(Configuration q, const Eigen::VectorXd& hand_sample) const;

 private:
  const PlanningProblem& problem_;
  sampling::PmdBasis basis_;
  sampling::ArmCorridor corridor_;
};

/// The problem's basis, or all hand joints as free axes.
[[nodiscard]] sampling::PmdBasis all_hand_joints(const PlanningProblem& problem);

}  // namespace handway::planning
