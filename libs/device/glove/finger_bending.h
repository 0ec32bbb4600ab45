#pragma once

#include "handway/device/glove/human_hand.h"

namespace handway::device {

/// Bending of the fingers towards the palm, rad, summed over their middle and outer joints: below 0
/// if these are landmarks of the other hand.
[[nodiscard]] double bending(const HandLandmarks& points, bool left);

}  // namespace handway::device
