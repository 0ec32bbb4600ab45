#pragma once

#include "handway/device/arm/simple_message.h"
#include "handway/device/core/joint_trajectory.h"

#include <vector>

namespace handway::device {

/// A point for the VAL3 server, and when it is sent.
struct Val3Point {
  double due = 0.0;  ///< s of the motion's time: not earlier.
  double end = 0.0;  ///< s: when the arm is there.
  SimpleMessage message;
};

/// How many points are sent ahead of their time: the queue holds ten.
inline constexpr std::size_t kVal3PointsAhead = 8;

/// The points of a trajectory but the first, where the arm stands. Points at which it does
/// not move are left out, and what follows them waits until they are over.
/// @pre check_trajectory().
[[nodiscard]] std::vector<Val3Point> val3_points(const JointTrajectory& trajectory,
                                                 const JointRanges& joints);

}  // namespace handway::device
