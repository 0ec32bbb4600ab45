#pragma once

#include "handway/sampling/export.h"

#include <cstdint>

namespace handway::sampling {

/// Element `index` of the van der Corput sequence: the radical inverse, the
/// digits of `index` in `base` mirrored at the radix point. Source: van der
/// Corput 1935; Kuipers and Niederreiter, "Uniform Distribution of Sequences".
/// @returns a number in [0, 1): 0, 1/2, 1/4, 3/4, 1/8, … in base 2.
/// @throws std::invalid_argument if base < 2.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT double van_der_corput(std::uint64_t index,
                                                            std::uint32_t base = 2);

/// Position number `index` of the paper's sweep along the segment from start to
/// goal (section 5.1): 0, 1, 1/2, 1/4, 3/4, 1/8, …, the van der Corput sequence
/// with the goal put in second place. For every power of two n, positions
/// 0 … n are the n + 1 multiples of 1/n, each once.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT double sweep_position(std::uint64_t index);

}  // namespace handway::sampling
