#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <vector>

namespace handway::gui {

/// The variables of arm and hand, by planning::make_problem's rule: the groups
/// "arm" and "hand", the basis' joints for the hand, the rest for the arm.
struct JointGroups {
  std::vector<int> arm;
  std::vector<int> hand;   ///< In the basis' joint order if there is a basis.
  std::vector<int> other;  ///< In neither.
};

/// @param basis may be null.
[[nodiscard]] JointGroups joint_groups(const geometric::RobotModel& model,
                                       const sampling::PmdBasis* basis);

/// The link that stands for the hand as a whole: the last that the arm moves, or
/// the one fixed to it that carries the fingers.
[[nodiscard]] int palm_link(const geometric::RobotModel& model, const JointGroups& groups);

/// The arm, and each finger by itself: variables of the hand of which one moves the other's link.
[[nodiscard]] std::vector<std::vector<int>> moving_parts(const geometric::RobotModel& model,
                                                         const JointGroups& groups);

}  // namespace handway::gui
