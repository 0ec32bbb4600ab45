#pragma once

#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/geometric/robot/robot_model.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace handway::gui {

/// Comparison of two mappings of the same motion of a glove.
struct MappingComparison {
  Eigen::VectorXd shares_a;  ///< Shares of variance, falling.
  Eigen::VectorXd shares_b;
  /// Angles between the spaces of the first k directions, rad; entry k-1. Only joints in both are
  /// considered.
  Eigen::VectorXd angles;
};

/// Compares two mappings by the postures that they make of the same motion.
/// @param frames at least two.
/// @param left_out names of joints that take no part in the principal components.
/// @throws geometric::InputError if a mapping does not fit the robot.
[[nodiscard]] MappingComparison compare_mappings(const std::vector<device::GloveAngles>& frames,
                                                 const device::HandMapping& a,
                                                 const device::HandMapping& b,
                                                 const geometric::RobotModel& model,
                                                 const std::vector<std::string>& left_out);

}  // namespace handway::gui
