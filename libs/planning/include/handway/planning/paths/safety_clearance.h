#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::planning {

/// Following error of a robot on a motion, and the clearance that has to remain.
struct SafetyMargin {
  /// Following error of each variable at its velocity limit, rad or m; shape [variable_count], ≥ 0.
  /// If of size 0: assumed_following_error().
  Eigen::VectorXd following_error;
  double margin = 0.0;  ///< m, ≥ 0.
};

/// Default following error if nothing was measured: 0.01 rad (0.57°) or 1 mm.
/// @returns shape [variable_count].
[[nodiscard]] HANDWAY_PLANNING_EXPORT Eigen::VectorXd assumed_following_error(
    const geometric::RobotModel& model);

/// Error that remains at rest, for example from the resolution of encoders, rad or m.
inline constexpr double kErrorAtRest = 5e-4;

/// A place where two bodies are nearer to each other than is safe.
struct ClearanceShortfall {
  std::string a;
  std::string b;
  double place = 0.0;            ///< Place of the configuration: s, or the waypoint.
  double clearance = 0.0;        ///< m
  double following = 0.0;        ///< Approach of the bodies by the joints' errors, m.
  double margin = 0.0;           ///< The requested margin, m.
  double following_error = 0.0;  ///< rad or m, the largest of a joint there.

  [[nodiscard]] double needed() const { return following + margin; }
  /// Margin to plan with, m; whole millimetres.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT double suggested_margin() const;
};

/// Compares the clearance with the sum of following errors and a margin, configuration by
/// configuration. Errors are mapped to distances by a bound of the motion of both bodies against
/// each other: the smaller of MotionBound and that of the bodies' bounding balls around the joints'
/// present axes, to first order of the errors.
class HANDWAY_PLANNING_EXPORT SafetyClearance {
 public:
  /// @param margin m.
  SafetyClearance(const PlanningProblem& problem, double margin);

  /// Evaluates `q` while each joint may be `error` away from it.
  /// @param error rad or m, ≥ 0; shape [variable_count]. @param place see ClearanceShortfall.
  void look(const Configuration& q, const Eigen::VectorXd& error, double place);

  /// Place with the least share of the needed clearance; nothing if it is sufficient everywhere.
  [[nodiscard]] const std::optional<ClearanceShortfall>& worst() const { return worst_; }

 private:
  /// Bound of the pair's approach by the errors, m. @pre the checker is placed.
  [[nodiscard]] double approach(int pair, const Eigen::VectorXd& error) const;
  [[nodiscard]] double displacement(int body, int frame, const Eigen::VectorXd& error) const;

  std::unique_ptr<geometric::CollisionChecker> checker_;
  std::shared_ptr<const geometric::MotionBound> motion_;
  double margin_;
  geometric::PairIndices near_;
  std::optional<ClearanceShortfall> worst_;
  double share_ = 1.0;  ///< Share of the needed clearance at the worst place.
};

/// Evaluates a path that is not timed, at rest everywhere. Places are waypoints, from 1.
/// @param margin m.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::optional<ClearanceShortfall> path_shortfall(
    const PlanningProblem& problem, const Path& path, double margin);

/// Text "a with b: 0.080 mm clearance where 3.2 mm are needed (2.2 mm for joints that are up to
/// 0.57° off, 1.0 mm margin)".
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string to_string(const ClearanceShortfall& shortfall);

}  // namespace handway::planning
