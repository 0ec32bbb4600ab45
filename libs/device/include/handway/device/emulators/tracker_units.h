#pragma once

#include "handway/device/emulators/device_emulator.h"
#include "handway/device/emulators/tracker_signals.h"
#include "handway/device/export.h"

#include <memory>

namespace handway::device {

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
