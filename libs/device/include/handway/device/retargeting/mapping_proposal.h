#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/geometric/robot/robot_model.h"

namespace handway::device {

/// Proposes a mapping for any robot hand of two to five fingers, from its kinematic tree: see
/// find_fingers(), whose fingers take the sensors of a person's.
///
///   - Joints of a finger that bend it take the inner, middle and outer sensor in the order of
///     the chain, one for one in rad from the straight finger. A joint that moves it sideways takes
///     the abduction; for the middle finger it is fixed at the straight finger. One more at its
///     root takes the palm's arch.
///   - The thumb's last two joints take its inner and outer sensor, its first ones roll and
///     abduction, whose typical ranges are mapped to the joints' whole ranges (paper, Table 1). A
///     joint before the last with another axis than the last is one of the first ones, unless
///     these are two already. So is that of a thumb of two joints that opposes and bends.
///   - Joints between root and palm of a robot without an arm take the wrist's sensors.
///   - A finger of one joint takes the inner sensor: from straight to the limit to which it
///     closes; a jaw from open to closed.
///   - A joint whose limits leave it no room takes no sensor, as if it were fixed.
///
/// Signs follow from the side to which the fingers close (find_fingers()), those of the thumb's
/// first joints from the motion of its tip. Results of mapping_doubts() are in `source`.
/// @param model a hand, or an arm with one: then the mapping leaves the arm's joints out.
/// @throws geometric::InputError as find_fingers().
[[nodiscard]] HANDWAY_DEVICE_EXPORT HandMapping propose_mapping(const geometric::RobotModel& model);

}  // namespace handway::device
