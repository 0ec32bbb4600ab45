#pragma once

#include "handway/device/glove/glove_frame.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/geometric/robot/robot_model.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace handway::gui {

/// What two mappings make of the same motion of a glove.
struct MappingComparison {
  Eigen::VectorXd shares_a;  ///< Of the variance, each principal direction, falling.
  Eigen::VectorXd shares_b;
  /// Between the spaces of the first k directions, rad; entry k-1. Only for joints in both.
  Eigen::VectorXd angles;
};

/// @param frames at least two.
/// @param left_out names of joints that take no part in the principal components.
/// @throws geometric::InputError if a mapping does not fit the robot.
[[nodiscard]] MappingComparison compare_mappings(const std::vector<device::GloveAngles>& frames,
                                                 const device::HandMapping& a,
                                                 const device::HandMapping& b,
                                                 const geometric::RobotModel& model,
                                                 const std::vector<std::string>& left_out);

}  // namespace handway::gui
