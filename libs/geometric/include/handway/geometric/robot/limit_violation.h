#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_model.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace handway::geometric {

/// Describes why `q` is not a configuration of the robot, regardless of limits: "has 5 values where
/// the robot has 7 variables", or "has no number for joint J"; empty if it is one.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string configuration_fault(const RobotModel& model,
                                                                       const Configuration& q);

/// Tolerance (rad or m) within which a joint beyond a limit counts as at it: encoders and files
/// round. Values rounded to single precision also meet a limit.
[[nodiscard]] inline double limit_tolerance(double limit) {
  constexpr double kTolerance = 1e-6;
  constexpr double kSingle = 1.0 / (1 << 23);
  return std::isfinite(limit) ? std::max(kTolerance, kSingle * std::abs(limit)) : kTolerance;
}

/// A joint out of its limits; rad or m.
struct LimitViolation {
  std::string joint;
  double value = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  std::string leader;  ///< The joint that it follows; empty if independent.
  JointType type = JointType::kRevolute;
};

/// Returns every joint that `q` puts out of its limits by more than limit_tolerance(), in the order
/// of the links. For a joint that is limited only because of a coupled one, the coupled one is
/// named.
/// @param q finite, shape [variable_count].
/// @param fixed variables that are ignored: joints that don't move can't be brought back.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<LimitViolation> limit_violations(
    const RobotModel& model, const Configuration& q, std::span<const int> fixed = {});

/// @param source what `q` is, for the message: "waypoint 3".
/// @param fixed as of limit_violations().
/// @throws InputError if `q` is not a configuration of the robot, or has limit_violations().
HANDWAY_GEOMETRIC_EXPORT void require_configuration(const RobotModel& model, const Configuration& q,
                                                    const std::string& source,
                                                    std::span<const int> fixed = {});

/// Text "joint J at 0.9000 rad, allowed -0.5000 to 0.5000 (22.9° beyond)", with the joint that it
/// follows; with more digits if these four make the value equal to the limit.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string to_string(const LimitViolation& violation);

}  // namespace handway::geometric
