#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/device/glove/recording.h"
#include "handway/geometric/robot/robot_model.h"

#include <string>
#include <vector>

namespace handway::device {

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
