#pragma once

#include "handway/device/export.h"
#include "handway/device/tracker/tracker.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace handway::device {

/// The longest datagram that is read, bytes.
inline constexpr std::size_t kLongestPoseDatagram = 1024;

/// Reads a pose from a UDP datagram: one JSON object in UTF-8 with
///
///     {"sensor": 0, "time": 12.345, "position": [x, y, z], "quaternion": [x, y, z, w],
///      "button": false}
///
/// position in m, quaternion of unit length within 1e-3 with its scalar last, as in VRPN; time in
/// s on the sender's clock; sensor from 0 to 255 (default 0); button may be left out; other keys
/// are ignored.
/// @returns the sample, its time that of the sender; nothing if the datagram is anything else.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::optional<TrackerSample> read_pose_datagram(
    std::span<const std::uint8_t> datagram);

/// @pre the sample's numbers are finite.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string write_pose_datagram(const TrackerSample& sample);

}  // namespace handway::device
