#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/recording.h"

/// Filters for a recording before it is analysed. They don't change their input.

namespace handway::device {

/// Resamples at even times from the first, by linear interpolation.
/// @param rate Hz, > 0.
/// @throws geometric::InputError if there are fewer than two times.
[[nodiscard]] HANDWAY_DEVICE_EXPORT Recording resampled(const Recording& recording, double rate);

/// Low-pass filter at `cutoff`: a Butterworth filter of second order, forwards and backwards, so
/// that it adds no delay. Both runs together have -3 dB at the cutoff (each is designed for 1.25
/// times it; Winter, Biomechanics and Motor Control of Human Movement, section 2.2.4.4) and are of
/// fourth order. Both ends are continued by point reflection. A recording with uneven times is
/// resampled at its median rate first.
/// @param cutoff Hz, > 0.
/// @throws geometric::InputError if it is not below 0.4 times the rate.
[[nodiscard]] HANDWAY_DEVICE_EXPORT Recording low_passed(const Recording& recording, double cutoff);

/// Removes rows whose values all equal those of the last remaining row: a glove that is read faster
/// than it samples repeats itself.
[[nodiscard]] HANDWAY_DEVICE_EXPORT Recording without_duplicates(const Recording& recording);

/// The rows from time `from` to `to` (s), both included.
/// @throws geometric::InputError if no rows are left.
[[nodiscard]] HANDWAY_DEVICE_EXPORT Recording trimmed(const Recording& recording, double from,
                                                      double to);

}  // namespace handway::device
