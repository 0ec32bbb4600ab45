#pragma once

#include "handway/sampling/export.h"

namespace handway::sampling {

/// STEPS of section 5.3: the smallest power of two n such that n + 1 evenly spaced
/// points of a segment of this length are no farther apart than `rho`; capped at
/// 2^20. Powers of two, so that sweep_position() visits each point once.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT int corridor_steps(double length, double rho);

}  // namespace handway::sampling
