#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/device/glove/recording.h"
#include "handway/geometric/robot/robot_model.h"

#include <string>
#include <vector>

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

/// A fitted mapping, and its doubts.
struct MappingFit {
  HandMapping mapping;
  std::vector<std::string> warnings;
};

/// Fits gains and offsets to the range of a person's hand (open, fist, thumb moves): of each joint
/// with a sensor but no curve, between the 2nd and the 98th percentile of its angles.
///
///   - Flexion goes from the joint's value at angle 0 to its limit in the direction of the gain.
///     A sensor that falls while the other fingers' sensors rise counts as reversed.
///   - Abduction keeps its middle, and is scaled until one side reaches its limit.
///   - Thumb roll and abduction, palm arch and wrist go over the joint's whole range.
///
/// Each mapping goes towards that only as far as it reduces the distance of the fingertips from the
/// person's, over the whole recording (fingertip_errors(), the mean): fitting never makes this
/// error larger. A sensor that moved by less than 5° keeps its mapping, with a warning.
/// @param person whose ranges and bones are taken.
/// @throws geometric::InputError if the recording holds counts, or the robot lacks a joint.
[[nodiscard]] HANDWAY_DEVICE_EXPORT MappingFit fit_mapping(const HandMapping& mapping,
                                                           const geometric::RobotModel& model,
                                                           const Recording& recording,
                                                           const GloveCalibration& person = {});

}  // namespace handway::device
