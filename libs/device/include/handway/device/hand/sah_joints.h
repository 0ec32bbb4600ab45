#pragma once

#include "handway/device/core/joint_trajectory.h"
#include "handway/device/export.h"

namespace handway::device {

/// Ranges and velocities of the 13 joints of the Schunk Anthropomorphic Hand (SAH) that move on
/// their own, in the order of its drives: thumb base; then abduction, proximal and medial joint of
/// thumb, index, middle and ring finger. A medial joint takes the distal one along. Flexion is
/// negative. The velocities, 120 degrees a second, are those that users of the related DLR/HIT
/// hand set: the SAH's maker publishes none.
[[nodiscard]] HANDWAY_DEVICE_EXPORT JointRanges sah_joints();

}  // namespace handway::device
