#pragma once

#include "handway/device/emulators/glove_emulator.h"
#include "handway/device/export.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/recording.h"

#include <cstdint>
#include <set>

namespace handway::device {

/// Errors of the readings of emulated sensors.
struct SensorFaults {
  double noise = 0.4;  ///< Standard deviation before rounding, counts; real gloves: 0.3 to 0.5.
  std::set<int> saturated;  ///< Sensors that always read 255.
};

/// The counts of a hand that moves as HandExploration: those of `calibration`, with noise,
/// rounded, clipped to 1 … 255. The calibration is the true one of the emulated glove, to be found
/// by calibrating it; by default typical_calibration(). The same seed and times give the same
/// counts.
[[nodiscard]] HANDWAY_DEVICE_EXPORT GloveSignal
exploring_hand_signal(std::uint64_t seed, const SensorFaults& faults = {},
                      const GloveCalibration& calibration = typical_calibration());

/// The counts of a recording, repeated forever; angles become counts by `calibration`. Sensors
/// missing in the recording read 128. Between two rows the former holds.
/// @param faults noise is added to the recorded counts: give 0 to play counts unchanged.
/// @throws geometric::InputError if the recording has no rows.
[[nodiscard]] HANDWAY_DEVICE_EXPORT GloveSignal
recorded_signal(const Recording& recording, std::uint64_t seed, const SensorFaults& faults,
                const GloveCalibration& calibration = typical_calibration());

/// Generates the recording of an emulated glove of 22 sensors with the typical calibration on a
/// hand that moves freely (HandExploration): counts with noise, evenly timed from 0. The same
/// arguments give the same recording; its header names them.
/// @param rows ≥ 1. @param rate Hz, > 0.
/// @throws std::invalid_argument for no rows or no rate.
[[nodiscard]] HANDWAY_DEVICE_EXPORT Recording generate_recording(std::uint64_t seed, int rows,
                                                                 double rate);

}  // namespace handway::device
