#pragma once

#include "handway/planning/export.h"
#include "handway/planning/timing/time_path.h"

#include <Eigen/Core>

#include <vector>

namespace handway::planning {

/// A move of an arm to a waypoint of a motion, from rest to rest and straight in the joints. This
/// is what controllers call a joint or point-to-point move: the joints start, reach their speeds,
/// brake and stop together.
struct JointMove {
  Eigen::VectorXd target;           ///< Shape [arm], rad or m.
  double duration = 0.0;            ///< Duration of this part of the motion, s.
  bool waits = false;               ///< The arm stays, for example while the hand moves.
  double largest_change = 0.0;      ///< Largest change of a joint, rad or m.
  double velocity_limit = 0.0;      ///< Rate of the finished share at full speed, 1/s.
  double acceleration_limit = 0.0;  ///< 1/s², at full speed.

  /// Returns the share of the joints' velocity limits at which a move with this share of their
  /// acceleration limits takes `duration`: a trapezium of speed. It is infinite if the acceleration
  /// is too low for that. @pre the arm moves.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT double velocity_share(double acceleration_share) const;
  /// Returns the duration of the move at these shares of the joints' limits, s.
  /// @pre the arm moves, and both are above 0.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT double duration_at(double velocity_share,
                                                           double acceleration_share) const;
};

/// Returns a move of the arm to each waypoint of the motion but the first.
/// @pre check_motion() accepts the motion.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<JointMove> joint_moves(const Motion& motion);

}  // namespace handway::planning
