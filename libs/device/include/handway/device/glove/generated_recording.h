#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/recording.h"

#include <cstdint>

namespace handway::device {

/// What an emulated glove of 22 sensors with the typical calibration would record of a hand that
/// moves freely (HandExploration): counts with noise, evenly timed from 0. The same arguments
/// give the same recording; its header names them.
/// @param rows ≥ 1. @param rate Hz, > 0.
/// @throws std::invalid_argument if there are no rows or no rate.
[[nodiscard]] HANDWAY_DEVICE_EXPORT Recording generate_recording(std::uint64_t seed, int rows,
                                                                 double rate);

}  // namespace handway::device
