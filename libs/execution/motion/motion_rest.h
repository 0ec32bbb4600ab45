#pragma once

#include "handway/execution/motion/motion_parts.h"

#include <vector>

namespace handway::execution {

/// Rests for the duration of a part, MotionPart::rests: polls the devices, and sends them nothing.
/// The time stands still during a hold. The part is held if the scene is not free where the robot
/// is. A fault of a device, a joint that leaves its place by more than the following tolerance, an
/// exception of a device or of the observer, or a stop ends it, and stops all devices.
/// @returns an outcome that has not started if it was stopped: nothing has moved.
[[nodiscard]] MotionOutcome run_rest(std::vector<MotionTarget>& targets, const MotionPart& part,
                                     const device::MotionTolerances& tolerances,
                                     MotionRequests& requests, MotionObserver& observer);

}  // namespace handway::execution
