#pragma once

#include "handway/geometric/robot/robot_description.h"

#include <Eigen/Core>

#include <map>
#include <string>

namespace handway::import_mjcf {

/// Two links that share a point, as bars of a linkage that a pin goes through.
struct ClosedLoop {
  std::string link_a;
  std::string link_b;
  Eigen::Vector3d p_AQ;  ///< The point, in link A's frame, m.
};

/// Keeps a loop closed by joints that follow its first one in proportion (`mimic`), as they do in
/// the parallelograms of grippers: within 1 mm where the first goes as far as the limits let it.
/// @param home values of joints by name, rad or m, with which the loop is closed; of others 0.
/// @returns false, and leaves the robot as it was, if no proportions do so or more joints are free.
[[nodiscard]] bool close_loop(geometric::RobotDescription& robot, const ClosedLoop& loop,
                              const std::map<std::string, double>& home);

}  // namespace handway::import_mjcf
