#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/planning/queries/palm_ik.h"

#include <Eigen/Core>

#include <string>

namespace handway::planning {

/// A motion of an arm that moves the palm along a straight line.
struct PalmLine {
  /// Waypoints from the begin of the line to its end. Empty if there is no such motion.
  Path path;
  /// Upper bound of the distance of the palm's origin from the line during the motion, m.
  double deviation = 0.0;
  /// Reason why there is no such motion, a sentence; empty if there is one.
  std::string fault;
};

/// Largest deviation of palm_line(), m.
inline constexpr double kLineDeviation = 1e-3;

/// Moves the palm by `shift_B` along a straight line. The orientation of the palm and the fingers
/// stay. The line is divided until the deviation between the waypoints is proven to be at most
/// kLineDeviation: for joints that move by Δq in all, it is at most R (Σ|Δq|)² / 8 beyond that of
/// the waypoints, where R is the radius of the reach_ball().
/// @param ik moves the palm of `model` by the joints `arm`. @param q configuration at the begin.
/// @param shift_B in the frame of the robot's base, m.
[[nodiscard]] HANDWAY_PLANNING_EXPORT PalmLine palm_line(const geometric::RobotModel& model,
                                                         const PalmIk& ik,
                                                         const geometric::JointIndices& arm,
                                                         const Configuration& q,
                                                         const Eigen::Vector3d& shift_B);

}  // namespace handway::planning
