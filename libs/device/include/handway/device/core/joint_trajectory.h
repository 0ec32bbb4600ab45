#pragma once

#include "handway/device/export.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace handway::device {

/// Joints of a device, in its order; vectors of shape [joints].
struct JointRanges {
  std::vector<std::string> names;
  Eigen::VectorXd lower;     ///< rad
  Eigen::VectorXd upper;     ///< rad
  Eigen::VectorXd velocity;  ///< Fastest that the device goes, rad/s; > 0.

  [[nodiscard]] Eigen::Index count() const { return lower.size(); }
};

/// Positions of a device's joints over time; between two points they move linearly.
struct JointTrajectory {
  std::vector<double> times;  ///< s, increasing from 0.
  Eigen::MatrixXd positions;  ///< rad, shape [points, joints].

  [[nodiscard]] double duration() const { return times.empty() ? 0.0 : times.back(); }
  /// The joints at `time`, which is clamped to the trajectory's. @pre not empty.
  [[nodiscard]] HANDWAY_DEVICE_EXPORT Eigen::VectorXd at(double time) const;
};

/// @throws geometric::InputError naming point and joint if the trajectory has less than two points,
/// is of another shape, holds numbers that are not finite, does not begin at 0, has times that
/// don't rise, or leaves the ranges or exceeds the velocities.
HANDWAY_DEVICE_EXPORT void check_trajectory(const JointTrajectory& trajectory,
                                            const JointRanges& joints);

}  // namespace handway::device
