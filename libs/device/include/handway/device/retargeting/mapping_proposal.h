#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/device/glove/recording.h"
#include "handway/geometric/robot/robot_model.h"

#include <string>
#include <vector>

namespace handway::device {

/// A mapping for any robot hand of two to five fingers, from its kinematic tree: see
/// find_fingers(), whose fingers take the sensors of a person's.
///
///   - Joints of a finger that bend it take the inner, middle and outer sensor in the order of the
///     chain, one for one in rad from where the finger is straight. The one that moves it sideways
///     takes the abduction; that of the middle finger stays where the finger is straight. One more
///     at its root takes the palm's arch.
///   - The thumb's last two joints take its inner and outer sensor, its first ones roll and
///     abduction, whose typical ranges go over the joints' whole ranges as in the paper's Table 1.
///     A joint before the last that turns about another axis than it is one of the first ones,
///     unless these are two already: so is that of a thumb of two joints that opposes and bends.
///   - Joints between root and palm of a robot without an arm take the wrist's sensors.
///   - A finger of one joint takes the inner sensor: from straight to the limit to that it closes;
///     a jaw from open to closed.
///   - A joint whose limits leave it no room takes nothing, as if it were fixed.
///
/// Signs follow from the side to that the fingers close (find_fingers()), of the thumb's first
/// joints from where they take its tip. What mapping_doubts() finds stands in `source`.
/// @param model a hand, or an arm with one: then the mapping leaves the arm's joints out.
/// @throws geometric::InputError as find_fingers().
[[nodiscard]] HANDWAY_DEVICE_EXPORT HandMapping propose_mapping(const geometric::RobotModel& model);

/// A fitted mapping, and its doubts.
struct MappingFit {
  HandMapping mapping;
  std::vector<std::string> warnings;
};

/// Fits gains and offsets to the range of a person's hand (open, fist, thumb moves): of each wire
/// with a sensor but no curve, between the 2nd and the 98th percentile of its angles.
///
///   - Flexion goes from the joint's value at angle 0 to its limit in the direction of the gain. A
///     sensor that falls while the other fingers' sensors rise is taken for reversed.
///   - Abduction keeps its middle, and is scaled until one side reaches its limit.
///   - Thumb roll and abduction, palm arch and wrist go over the joint's whole range.
///
/// Each wire goes towards that only as far as it reduces the distance of the fingertips from the
/// person's, over the whole recording (fingertip_errors(), the mean): fitting never makes this
/// error larger. A sensor that moved by less than 5° keeps its wire, with a warning.
/// @param person whose ranges and bones are taken.
/// @throws geometric::InputError if the recording holds counts, or the robot lacks a joint.
[[nodiscard]] HANDWAY_DEVICE_EXPORT MappingFit fit_mapping(const HandMapping& mapping,
                                                           const geometric::RobotModel& model,
                                                           const Recording& recording,
                                                           const GloveCalibration& person = {});

}  // namespace handway::device
