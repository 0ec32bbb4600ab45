#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_frame.h"

#include <span>

namespace handway::device {

/// What one sensor of an emulated glove reads: counts = zero + angle / gain.
struct SensorResponse {
  double zero;  ///< Counts at 0 rad.
  double gain;  ///< rad a count, positive: counts rise with the angle.
};

/// The sensors of the emulated glove, in the order of cyberglove_sensors(): the true calibration
/// that a calibration procedure should find. Gains are those that VirtualHand has for
/// CyberGloves (of abductions, which it doesn't tell, those of GraspIt!'s example calibration);
/// the zeros are chosen so that all anatomic postures stay within 1 to 255 and a relaxed hand
/// reads about what real ones do. Signs of angles are those of HandExploration.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::span<const SensorResponse> emulated_response();

}  // namespace handway::device
