#pragma once

#include "handway/planning/export.h"
#include "handway/planning/timing/blended_path.h"
#include "handway/planning/timing/rate_limits.h"
#include "handway/planning/timing/time_law.h"

namespace handway::planning {

/// A fast way along `path` that keeps the limits, jerk included, from rest to rest, stopping
/// at corners that have no arc. The path is the same to the bit: only its times are other ones.
///
/// From stop to stop time_optimal() is averaged over a window of time: its acceleration, which
/// jumps, becomes one that changes evenly, by no more than its jumps in the window's length. Then
/// the stretch is slowed down to where velocity, acceleration and jerk of all joints are in their
/// limits. Of several windows, and of several shares of the accelerations to begin with, the
/// fastest is taken. Nearly, not quite as fast as can be: the limits are met where one joint
/// is at its worst.
/// @pre limits.jerk is of the model's shape.
/// @throws std::invalid_argument if the path has circular arcs, where no jerk is limited.
[[nodiscard]] HANDWAY_PLANNING_EXPORT TimeLaw jerk_limited(const BlendedPath& path,
                                                           const RateLimits& limits);

}  // namespace handway::planning
