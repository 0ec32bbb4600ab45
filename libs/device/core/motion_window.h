#pragma once

#include "handway/device/core/joint_trajectory.h"

namespace handway::device {

/// How much of a motion a device is trusted with at once, s.
struct WindowLength {
  double follow = 0.2;  ///< As planned,
  double brake = 0.25;  ///< and then evenly slower, to rest.
};

/// The next stretch of a motion as a whole one of its own: a device that hears no more follows it
/// to its end and stands, having braked on the planned path.
/// @param time where it begins, s of `motion`; its own times begin a few ms after 0 and end with
/// `length`, or where the motion does.
[[nodiscard]] JointTrajectory motion_window(const JointTrajectory& motion, double time,
                                            const WindowLength& length);

}  // namespace handway::device
