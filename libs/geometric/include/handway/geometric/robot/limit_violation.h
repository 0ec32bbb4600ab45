#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_model.h"

#include <string>
#include <vector>

namespace handway::geometric {

/// Why `q` is no configuration of the robot, whatever its limits: "has 5 values where the robot has
/// 7 variables", or "has no number for joint J"; empty if it is one.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string configuration_fault(const RobotModel& model,
                                                                       const Configuration& q);

/// A joint out of its limits; rad or m.
struct LimitViolation {
  std::string joint;
  double value = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  std::string leader;  ///< The joint that it follows; empty if it moves on its own.
};

/// Every joint that `q` puts out of its limits by more than `tolerance` (rad or m), in
/// the order of the links. Of a joint that is limited only for the sake of a coupled
/// one, the coupled one is named.
/// @param q finite, shape [variable_count].
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<LimitViolation> limit_violations(
    const RobotModel& model, const Configuration& q, double tolerance = 1e-9);

/// @param source what `q` is, for the message: "waypoint 3".
/// @throws InputError if `q` is no configuration of the robot, or puts a joint out of its limits by
/// more than 1e-6 rad or m.
HANDWAY_GEOMETRIC_EXPORT void require_configuration(const RobotModel& model, const Configuration& q,
                                                    const std::string& source);

/// "joint J at 0.9000, allowed -0.5000 to 0.5000", and which joint it follows; with more digits
/// where these four make the value look as if it were the limit.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string to_string(const LimitViolation& violation);

}  // namespace handway::geometric
