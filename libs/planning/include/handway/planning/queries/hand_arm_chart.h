#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace handway::planning {

/// Few coordinates that describe the place of a configuration between start and goal and the
/// posture of its hand, for display.
class HANDWAY_PLANNING_EXPORT HandArmChart {
 public:
  /// @param problem outlives this.
  explicit HandArmChart(const PlanningProblem& problem);

  /// One axis.
  struct Axis {
    enum class Kind { kArmWay, kArmDistance, kFreeJoint, kDirection, kHandDistance };
    Kind kind;
    std::string name;  ///< Joint or direction, as in the basis; else empty.
  };
  /// Axes of the chart: progress along the straight motion of the arm (0: start, 1: goal;
  /// normalised joints) and distance from it. With a basis, also its free joints and principal
  /// directions (the coordinates e of Eq. 1), and the distance of the posture from their span.
  [[nodiscard]] const std::vector<Axis>& axes() const { return axes_; }

  /// @returns shape [axes].
  [[nodiscard]] Eigen::VectorXd at(const Configuration& q) const;

 private:
  const PlanningProblem& problem_;
  std::vector<Axis> axes_;
  Eigen::VectorXd arm_start_;                          ///< Normalised.
  Eigen::VectorXd arm_motion_;                         ///< Vector from there to the goal.
  std::optional<sampling::PostureSubspace> subspace_;  ///< Empty: no basis.
};

}  // namespace handway::planning
