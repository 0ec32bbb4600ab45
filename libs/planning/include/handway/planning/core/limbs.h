#pragma once

#include "handway/geometric/robot/robot_model.h"
#include "handway/planning/export.h"

#include <vector>

namespace handway::planning {

/// Arm of a robot with several arms, with the hand that it carries.
struct Limb {
  std::vector<int> arm;   ///< Its own variables, ascending, without those shared by other arms.
  std::vector<int> hand;  ///< In the given order.
};

/// The limbs of a robot whose arm branches, in the order of the ends of its arms. Joints shared by
/// several arms, as a torso, belong to none of them.
/// @param arm, hand variables of the robot. @returns one limb if the arm does not branch.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<Limb> limbs(const geometric::RobotModel& model,
                                                              const std::vector<int>& arm,
                                                              const std::vector<int>& hand);

}  // namespace handway::planning
