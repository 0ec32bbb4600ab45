#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/planning/export.h"
#include "handway/planning/timing/blended_path.h"
#include "handway/planning/timing/kinematic_limits.h"
#include "handway/planning/timing/time_parameterization.h"

#include <span>
#include <string>
#include <vector>

namespace handway::planning {

/// The joints at one time; all of shape [variable_count].
struct TrajectoryPoint {
  double time = 0.0;                  ///< s
  geometric::Configuration position;  ///< rad or m
  Eigen::VectorXd velocity;           ///< rad/s or m/s
  Eigen::VectorXd acceleration;       ///< rad/s² or m/s²
};

/// A motion as samples in order of time; between two of them positions move linearly.
struct Trajectory {
  std::vector<TrajectoryPoint> points;

  [[nodiscard]] bool empty() const { return points.empty(); }
  [[nodiscard]] double duration() const {
    return points.empty() ? 0.0 : points.back().time - points.front().time;
  }
};

/// State of the motion at `time`, which is clamped to the law's. At a join the earlier acceleration
/// counts, at the very end rest.
[[nodiscard]] HANDWAY_PLANNING_EXPORT TrajectoryPoint point_at(const BlendedPath& path,
                                                               const TimeParameterization& law,
                                                               double time);

/// Samples at 0, period, 2 period, … up to the end, which is bitwise the path's. A law that does
/// not end at a multiple of the period ends with a shorter step. A path without length gives two
/// points in the same place.
/// @throws std::invalid_argument if period is not above 0 or for more than 10 million
/// points.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Trajectory sample(const BlendedPath& path,
                                                        const TimeParameterization& law,
                                                        double period);

/// Adds points to the rests of a trajectory: where two points are farther apart than `period` (s),
/// there are points after each period.
/// @pre the joints are at rest between two such points, and period is above 0.
/// @throws InputError for more than 10 million points.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Trajectory with_rests_sampled(const Trajectory& trajectory,
                                                                    double period);

/// Time at which the motion passes each waypoint of the path (the middle of its arc), s; shape
/// [waypoints].
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<double> waypoint_times(
    const BlendedPath& path, const TimeParameterization& law);

/// Lower bound (s) of the duration of any motion through the path's waypoints in straight lines:
/// each joint alone, from rest to rest, from one of its turning points to the next, at its velocity
/// and acceleration limits.
[[nodiscard]] HANDWAY_PLANNING_EXPORT double least_duration(const Path& path,
                                                            const JointKinematicLimits& limits);

/// Reason why a trajectory must not run.
struct TrajectoryFault {
  std::string joint;   ///< Empty: not about a joint.
  double time = 0.0;   ///< Time of the first faulty point, s.
  double value = 0.0;  ///< Actual value: rad, rad/s, rad/s² (or m), s.
  std::string text;    ///< A sentence with all these data.
};

/// Finds faults that a controller would refuse: no points, points of another size, numbers that are
/// not finite, time that does not increase, a first or last point that is not at rest; joints
/// beyond their limits, coupled ones included; velocities and accelerations beyond `limits`, both
/// the given ones and those between consecutive points; jerk, if it is limited, by the
/// accelerations. Of each kind the first for each joint.
/// @param fixed variables whose positions are ignored, as in geometric::limit_violations().
/// @pre limits are of the model's shape.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<TrajectoryFault> check_trajectory(
    const geometric::RobotModel& model, const Trajectory& trajectory,
    const JointKinematicLimits& limits, std::span<const int> fixed = {});

}  // namespace handway::planning
