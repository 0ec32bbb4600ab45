#pragma once

#include "convex_parts.h"

#include <vector>

namespace handway::simulate_mujoco {

/// convex_parts(), from the user's cache if this mesh was divided before: it takes up to a second
/// for the links of a hand. For any thread.
[[nodiscard]] std::vector<ConvexPart> cached_convex_parts(const geometric::TriangleMesh& mesh,
                                                          const ConvexPartsLimits& limits = {});

}  // namespace handway::simulate_mujoco
