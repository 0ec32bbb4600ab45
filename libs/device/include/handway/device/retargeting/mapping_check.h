#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/geometric/robot/robot_model.h"

#include <string>
#include <vector>

namespace handway::device {

/// Plays a person's hand that closes from flat to a fist through a mapping, and returns as
/// sentences what the robot's hand does otherwise: a finger that is not straight when the hand is
/// open, that does not bend to the palm and towards the thumb when it closes, or joints that are at
/// their limits for most of the motion. Where the geometry does not tell for certain how the hand
/// closes (RobotFingers::doubts), that comes first.
/// @returns nothing if the mapping does what a person's hand does.
/// @throws geometric::InputError as find_fingers() and HandMapper.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::vector<std::string> mapping_doubts(
    const HandMapping& mapping, const geometric::RobotModel& model);

/// Says that most of the samples that a mapping or a retargeting made of a recording are at a limit
/// of some joint, and so not what the person did: a sentence, or empty if they are not.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string clamping_warning(const MappedPostures& mapped);

}  // namespace handway::device
