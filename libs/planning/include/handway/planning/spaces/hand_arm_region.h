#pragma once

#include "handway/planning/export.h"
#include "handway/planning/spaces/state_space.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <Eigen/Core>

#include <memory>
#include <optional>

namespace handway::planning {

/// Which hand postures a planner draws from.
enum class HandSpace {
  kPrincipalDirections,  ///< SC^h: free joints and principal motion directions (the paper's
                         ///< method).
  kAllJoints,            ///< C^h: every joint over its range (its comparison, section 6.2).
};

/// The paper's sampling regions (section 5.1): the arm in a corridor around its straight motion,
/// the hand in the box of its axes.
class HANDWAY_PLANNING_EXPORT HandArmRegion {
 public:
  /// The hand's axes are those of the problem's basis, or, for kAllJoints and where it has none,
  /// every hand joint on its own. @param problem must outlive this object.
  /// @throws InputError as make_corridor_space().
  HandArmRegion(const PlanningProblem& problem, HandSpace hand, CorridorForm form);

  [[nodiscard]] const CorridorSpace& space() const { return *space_; }
  [[nodiscard]] const sampling::PmdBasis& basis() const { return basis_; }

  /// c_a from the hypercube at `step`, with the hand as at the start; nothing if
  /// the chosen tool pose is out of reach. Among several arm postures the one
  /// nearest to the straight motion is taken. @param u as CorridorSpace::corridor_point().
  [[nodiscard]] std::optional<Configuration> arm_at(double step, double rho,
                                                    const Eigen::VectorXd& u) const;

  /// (c_a, MAP(sc_h)): `q` with the hand at the posture of `u` in [0,1]^k, of the first k axes.
  [[nodiscard]] Configuration with_hand(Configuration q, const Eigen::VectorXd& u) const;

 private:
  const PlanningProblem& problem_;
  sampling::PmdBasis basis_;
  std::unique_ptr<CorridorSpace> space_;
};

}  // namespace handway::planning
