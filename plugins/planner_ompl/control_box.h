#pragma once

#include "handway/planning/planners/target_region.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/regions/arm_corridor.h"
#include "state_map.h"

#include <array>
#include <vector>

namespace handway::planner_ompl {

/// Where a ControlBox lies and how it is drawn from. Its corridor is the joints'.
struct ControlRegion {
  planning::TargetRegion target = {.near_ends = 0.5};
  int max_pmds = 4;  ///< Principal directions of the space; fewer if the basis has fewer.
};

/// The controls of the paper's method: along the arm's straight motion and across it
/// within the widest corridor (section 5.1), the hand's free joints and principal
/// motion directions (section 4.2). Two more coordinates lead from the subspace of
/// the hand to the postures at start and goal, which seldom lie in it: how much of the
/// start's and of the goal's deviation is kept.
///
/// Coordinates are lengths in joints normalised to [0, 1], so that distances are
/// nearly those of the joints; joints that get beyond their limits are moved onto them.
/// Coordinates without extent, as the deviation of a posture of the subspace, are left out.
class ControlBox final : public StateMap {
 public:
  /// @param problem must outlive this object. @pre it has a basis.
  ControlBox(const planning::PlanningProblem& problem, const ControlRegion& region);

  /// As the planners with PMDs draw: the arm from a corridor that widens, the hand from
  /// its subspace; or both around start or goal.
  [[nodiscard]] Eigen::VectorXd draw(sampling::RandomStream& stream,
                                     std::uint64_t sample) const override;

 protected:
  [[nodiscard]] Eigen::VectorXd coordinates(const planning::Configuration& q) const override;
  [[nodiscard]] planning::Configuration configuration(const Eigen::VectorXd& x) const override;

 private:
  [[nodiscard]] Eigen::VectorXd end_controls(int end, const Eigen::VectorXd& arm,
                                             const Eigen::VectorXd& e, double deviation) const;
  [[nodiscard]] Eigen::VectorXd in_hand_box(const Eigen::VectorXd& posture) const;
  [[nodiscard]] Eigen::VectorXd across(const Eigen::VectorXd& arm_joints) const;
  [[nodiscard]] Eigen::VectorXd random_hand(sampling::RandomStream& stream) const;
  void set_up_hand();
  void set_up_box();

  ControlRegion region_;
  sampling::PmdBasis basis_;                 ///< With no more directions than are used.
  std::vector<int> arm_;                     ///< Variables with a range that are not the hand's.
  std::array<Eigen::VectorXd, 2> arm_ends_;  ///< Normalised joints at start and goal.
  sampling::ArmCorridor corridor_;
  Eigen::MatrixXd frame_;  ///< Columns: the corridor's direction, then others across it.
  Eigen::MatrixXd axes_;   ///< Columns: e's axes, then the deviations at start and goal.
  Eigen::VectorXd centre_;
  Eigen::VectorXd half_sides_;
  std::array<Eigen::VectorXd, 2> end_hands_;  ///< e nearest to start and goal in the hand's box.
  std::array<double, 2> deviations_{};        ///< Of start and goal from there.
  std::vector<int> kept_;                     ///< Coordinates with an extent.
};

}  // namespace handway::planner_ompl
