#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/planning/export.h"

#include <Eigen/Core>

#include <vector>

namespace handway::planning {

/// The outermost link of each finger: links that the hand's joints move and that carry no other
/// one. @param hand its variables.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<int> fingertips(
    const geometric::RobotModel& model, const std::vector<int>& hand);

/// The middle of a link's shape, in its frame, m; its origin if it has none.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Eigen::Vector3d middle_of(const geometric::Link& link);

}  // namespace handway::planning
