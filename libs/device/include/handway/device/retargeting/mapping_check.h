#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/device/glove/posture_source.h"
#include "handway/geometric/robot/robot_model.h"

#include <string>
#include <vector>

namespace handway::device {

/// Plays a person's hand that closes from flat to a fist through a mapping, and returns the
/// differences of the robot's hand as sentences: a finger that is not straight when the hand is
/// open, that does not bend to the palm and towards the thumb when it closes, or joints that are at
/// their limits for most of the motion. If the geometry leaves doubts about the direction of
/// closing (RobotFingers::doubts), these come first.
/// @returns nothing if the robot's hand does as the person's hand.
/// @throws geometric::InputError as find_fingers() and HandMapper.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::vector<std::string> mapping_doubts(
    const HandMapping& mapping, const geometric::RobotModel& model);

/// Warns, in a sentence, that most of the samples that a mapping or a retargeting made of a
/// recording are at a limit of some joint, and so differ from the person's motion; otherwise empty.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string clamping_warning(const MappedPostures& mapped);

}  // namespace handway::device
