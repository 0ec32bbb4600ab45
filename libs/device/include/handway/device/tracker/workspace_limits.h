#pragma once

#include "handway/device/export.h"

#include <Eigen/Geometry>

#include <limits>

namespace handway::device {

/// Where a tool may go: a box and a ball, both in the robot's base frame B, m. By default
/// everywhere.
struct WorkspaceLimits {
  Eigen::AlignedBox3d box{Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity()),
                          Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity())};
  Eigen::Vector3d reach_centre = Eigen::Vector3d::Zero();  ///< Such as the arm's shoulder.
  double reach = std::numeric_limits<double>::infinity();  ///< Radius of the ball.
};

/// @throws std::invalid_argument if the box is empty, the reach isn't above 0, a number is not a
/// number, or box and ball have no point in common.
HANDWAY_DEVICE_EXPORT void check_workspace(const WorkspaceLimits& limits);

/// `point` if it is inside, else a point of the limits' surface near to it; within 1e-6 m.
/// @param point m, finite. @pre check_workspace(limits) passes.
[[nodiscard]] HANDWAY_DEVICE_EXPORT Eigen::Vector3d nearest_inside(const WorkspaceLimits& limits,
                                                                   const Eigen::Vector3d& point);

}  // namespace handway::device
