#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/planning/export.h"
#include "handway/planning/timing/rate_limits.h"
#include "handway/planning/timing/trajectory.h"

#include <string>
#include <vector>

namespace handway::planning {

/// Why a trajectory must not run.
struct TrajectoryFault {
  std::string joint;   ///< Empty: not of a joint.
  double time = 0.0;   ///< s, of the first point that is at fault.
  double value = 0.0;  ///< What is there: rad, rad/s, rad/s² (or m), s.
  std::string text;    ///< A sentence with all of this.
};

/// Finds what a controller would choke on: no points, points of another size, numbers
/// that are not finite, time that does not increase, a first or last point that is
/// not at rest; joints beyond their limits, coupled ones included; velocities and accelerations
/// beyond `limits`, as they are written and as they follow from one point to the next; jerk, if it
/// is limited, as it follows from accelerations. Of each kind the first for each joint.
/// @pre limits are of the model's shape.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<TrajectoryFault> check_trajectory(
    const geometric::RobotModel& model, const Trajectory& trajectory, const RateLimits& limits);

}  // namespace handway::planning
