#pragma once

#include "handway/planning/export.h"
#include "handway/planning/timing/blended_path.h"
#include "handway/planning/timing/kinematic_limits.h"

#include <stop_token>
#include <vector>

namespace handway::planning {

/// Time parameterization of a path: between two knots the acceleration along the path changes
/// evenly, or not at all, and the path is one piece. Where the motion stops, a second knot at the
/// same time begins the next stretch.
struct TimeParameterization {
  /// Position and speed on the path at a time.
  struct Knot {
    double time = 0.0;          ///< s
    double s = 0.0;             ///< Arc length from the beginning of the path.
    double speed = 0.0;         ///< ds/dt ≥ 0; 0 at stops alone.
    double acceleration = 0.0;  ///< d²s/dt² from here on.
    double jerk = 0.0;          ///< d³s/dt³ up to the next knot.

    /// The motion `t` s later, with the jerk of this knot.
    [[nodiscard]] Knot after(double t) const;
  };
  std::vector<Knot> knots;  ///< Empty for a path without length.

  [[nodiscard]] double duration() const { return knots.empty() ? 0.0 : knots.back().time; }
};

/// The fastest motion along `path` that keeps the limits, from rest to rest, stopping at corners
/// that have no arc. Jerk is not limited: accelerations jump; see jerk_limited(). If limits.jerk is
/// given, speeds on arcs are so low that their shape alone does not exceed it.
///
/// Source: Pham, Pham, "A new approach to time-optimal path parameterization based on
/// reachability analysis", IEEE Transactions on Robotics 34(3), 2018 (TOPP-RA). A
/// backward pass finds the speeds from which the rest is feasible; a forward pass goes
/// as fast as these allow, on a grid that has the path's joins in it. Limits are
/// evaluated at both ends of a cell; excesses of arcs in between are removed by
/// stretching time.
/// @pre path and limits have the same number of variables.
[[nodiscard]] HANDWAY_PLANNING_EXPORT TimeParameterization
time_optimal(const BlendedPath& path, const JointKinematicLimits& limits);

/// Returns the motion with every stretch from stop to stop slowed down to the next multiple of
/// `period` (s), so that samples at this period meet the stops. @pre period > 0.
[[nodiscard]] HANDWAY_PLANNING_EXPORT TimeParameterization
align_stops(const TimeParameterization& law, double period);

/// A fast motion along `path` that keeps the limits, jerk included, from rest to rest, stopping at
/// corners that have no arc. The path is bitwise the same: only its times differ.
///
/// From stop to stop time_optimal() is averaged over a window of time: its acceleration, which
/// jumps, becomes one that changes evenly, by at most its jumps in the window's length. Then the
/// stretch is slowed down until velocity, acceleration and jerk of all joints are in their
/// limits. Of several windows, and of several initial shares of the accelerations, the fastest
/// is taken. The result is nearly optimal: the limits are reached where one joint is at its
/// worst.
/// @pre limits.jerk is of the model's shape.
/// @throws std::invalid_argument if the path has circular arcs, where no jerk is limited;
/// geometric::PreparationStopped if `stop` is requested.
[[nodiscard]] HANDWAY_PLANNING_EXPORT TimeParameterization jerk_limited(
    const BlendedPath& path, const JointKinematicLimits& limits, const std::stop_token& stop = {});

}  // namespace handway::planning
