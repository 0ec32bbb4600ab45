#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/planning/export.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace handway::planning {

/// A joint without an acceleration limit is assumed to reach its velocity limit in this time, s.
/// Neither URDF nor the makers' leaflets of the TX90 and the SAH have accelerations; four times the
/// velocity is modest for arms of that size.
inline constexpr double kDefaultRampTime = 0.25;

/// A joint without a jerk limit is assumed to reach its acceleration limit in this time, s.
inline constexpr double kDefaultJerkTime = 0.1;

/// Time derivative of a joint's position that has a limit.
enum class Rate { kVelocity, kAcceleration, kJerk };

/// "velocity", "acceleration" or "jerk".
[[nodiscard]] HANDWAY_PLANNING_EXPORT const char* rate_name(Rate rate);

/// A limit that is missing in all files and replaced by one of the defaults above.
struct AssumedLimit {
  std::string joint;  ///< The variable's.
  Rate rate = Rate::kAcceleration;
  double value = 0.0;  ///< Limit in rad/s, rad/s² or rad/s³, or m.

  bool operator==(const AssumedLimit&) const = default;
};

/// Limits of the rates of a robot's variables; all > 0.
struct JointKinematicLimits {
  Eigen::VectorXd velocity;      ///< Shape [variable_count], rad/s or m/s.
  Eigen::VectorXd acceleration;  ///< Shape [variable_count], rad/s² or m/s².
  Eigen::VectorXd jerk{};        ///< Shape [variable_count], rad/s³ or m/s³; size 0: not limited.
  std::vector<AssumedLimit> assumed{};  ///< By rate, then by variable.
  /// Limits of positions that are narrower than the robot's own: shape [variable_count], rad or m;
  /// size 0: none.
  Eigen::VectorXd lower{};
  Eigen::VectorXd upper{};

  /// Returns the limits of the same motions at `speed` times their pace: velocities by it,
  /// accelerations by its square, jerk by its cube; without `assumed`. @pre speed > 0.
  [[nodiscard]] JointKinematicLimits at_speed(double speed) const {
    return {velocity * speed,
            acceleration * (speed * speed),
            jerk * (speed * speed * speed),
            {},
            lower,
            upper};
  }

  /// Returns the limits without those of jerk, assumed ones included.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT JointKinematicLimits without_jerk() const;
};

/// Text for display: a line for each rate with assumed limits.
/// @param most joints to name in a line; the rest is counted.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<std::string> assumption_lines(
    const std::vector<AssumedLimit>& assumed,
    std::size_t most = std::numeric_limits<std::size_t>::max());

/// The limits of the robot's joints, with the defaults above. A variable also keeps the limits of
/// the joints that are coupled to it.
///
/// If `joint_limits.yaml` exists beside the robot's file its limits are added, as by
/// read_joint_kinematic_limits().
/// @throws InputError if that file is invalid.
[[nodiscard]] HANDWAY_PLANNING_EXPORT JointKinematicLimits
rate_limits(const geometric::RobotModel& model);

/// The limits of the robot's joints, replaced where `file` has others. The file is
/// read by geometric::read_joint_limits(); its limits of positions narrow the robot's own.
/// @throws InputError naming line and key, also for a joint that the robot lacks: limits that a
/// user relies on must not be ignored.
[[nodiscard]] HANDWAY_PLANNING_EXPORT JointKinematicLimits
read_joint_kinematic_limits(const geometric::RobotModel& model, const std::filesystem::path& file);

}  // namespace handway::planning
