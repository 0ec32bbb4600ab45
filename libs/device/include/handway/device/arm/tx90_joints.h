#pragma once

#include "handway/device/core/joint_trajectory.h"
#include "handway/device/export.h"

namespace handway::device {

/// Ranges and nominal speeds of the Staeubli TX90's six joints.
/// Source: Staeubli, TX90 data sheet.
[[nodiscard]] HANDWAY_DEVICE_EXPORT JointRanges tx90_joints();

}  // namespace handway::device
