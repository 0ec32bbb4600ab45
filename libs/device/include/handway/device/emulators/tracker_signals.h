#pragma once

#include "handway/device/export.h"
#include "handway/geometric/math/pose.h"

#include <cstdint>
#include <functional>

namespace handway::device {

/// Pose X_ST of an emulated tracker's sensor (from 1) over time: s, never falling from one call to
/// the next.
using TrackerSignal = std::function<geometric::Pose(double time, int sensor)>;

/// Noise of the poses of emulated sensors; by default that of a magnetic tracker within 75 cm of
/// its source.
struct TrackerNoise {
  double position = 0.0002;  ///< Standard deviation of each coordinate, m.
  double angle = 0.0005;     ///< Standard deviation of each rotation-vector component, rad.
};

/// The poses of a wrist that explores its workspace: minimum-jerk moves in a box of 50 × 50 × 40 cm
/// in front of the source, turning by up to 40° about each axis, with noise. Each sensor has a
/// motion of its own. The same seed and times give the same poses.
[[nodiscard]] HANDWAY_DEVICE_EXPORT TrackerSignal
wrist_motion_signal(std::uint64_t seed, const TrackerNoise& noise = {});

}  // namespace handway::device
