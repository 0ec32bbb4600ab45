#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_model.h"

#include <memory>

namespace handway::geometric {

/// The hand of a robot as a robot of its own, with the names that it has there: what hangs from the
/// last link that all joints of the hand have in common. The hand is the group "hand", or without
/// one what propose_groups() finds.
/// @returns the robot itself if there is nothing to leave out, or no hand.
/// @throws InputError if a joint of the hand follows one of the arm.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::shared_ptr<const RobotModel> hand_alone(
    const std::shared_ptr<const RobotModel>& robot);

}  // namespace handway::geometric
