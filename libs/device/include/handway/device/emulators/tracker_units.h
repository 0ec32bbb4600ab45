#pragma once

#include "handway/device/emulators/device_emulator.h"
#include "handway/device/export.h"
#include "handway/geometric/math/pose.h"

#include <cstdint>
#include <functional>
#include <memory>

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

/// Properties of an emulated tracker.
struct TrackerUnitSettings {
  int sensors = 1;      ///< A Fastrak has up to 4, a Liberty 16.
  double rate = 120.0;  ///< Poses a second; a Fastrak shares them among its sensors, Hz.
  bool button = false;  ///< The first sensor is a stylus, its button pressed every other second.
};

/// An emulated Polhemus Fastrak: continuous and polled, ASCII and binary, inches and
/// centimetres, output lists of each station, status.
/// @throws std::invalid_argument unless it has 1 to 4 sensors, and a rate above 0.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::unique_ptr<DeviceUnit> make_fastrak_unit(
    const TrackerUnitSettings& settings, TrackerSignal signal);

/// An emulated Polhemus Liberty in binary: continuous and polled, inches and centimetres, one
/// output list, map of its stations.
/// @throws std::invalid_argument unless it has 1 to 16 sensors, and a rate above 0.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::unique_ptr<DeviceUnit> make_liberty_unit(
    const TrackerUnitSettings& settings, TrackerSignal signal);

/// Sends write_pose_datagram(), all sensors (from 0) at `rate`; receives nothing.
/// @throws std::invalid_argument unless it has 1 to 256 sensors, and a rate above 0.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::unique_ptr<DeviceUnit> make_datagram_unit(
    const TrackerUnitSettings& settings, TrackerSignal signal);

}  // namespace handway::device
