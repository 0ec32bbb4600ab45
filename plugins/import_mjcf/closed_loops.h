#pragma once

#include "handway/geometric/robot/robot_description.h"

#include <Eigen/Core>

#include <map>
#include <string>

namespace handway::import_mjcf {

/// Two links that share a point, as bars of a linkage at a pin.
struct ClosedLoop {
  std::string link_a;
  std::string link_b;
  Eigen::Vector3d p_AQ;  ///< The point, in link A's frame, m.
};

/// Keeps a loop closed by joints that follow its first one in proportion (`mimic`), as in the
/// parallelograms of grippers: within 1 mm over the range of the first that the limits allow.
/// @param home values of joints by name, rad or m, at which the loop is closed; others are 0.
/// @returns false, without a change of the robot, if no proportions fit or more joints are free.
[[nodiscard]] bool close_loop(geometric::RobotDescription& robot, const ClosedLoop& loop,
                              const std::map<std::string, double>& home);

}  // namespace handway::import_mjcf
