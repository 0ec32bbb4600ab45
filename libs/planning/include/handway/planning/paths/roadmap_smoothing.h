#pragma once

#include "handway/planning/core/planning_context.h"
#include "handway/planning/export.h"
#include "handway/planning/paths/path.h"

#include <cstdint>
#include <limits>

namespace handway::planning {

/// The paper's smoothing (section 5.3, FINDPATH): "a new (small) roadmap composed
/// of the nodes of the path and all collision-free edges between them", and its
/// shortest way. Interrupted, it gives the best way known by then.
/// @param checks configurations to spend, by a single edge's more at most.
/// @pre every edge of `path` is free.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Path
smooth_by_roadmap(PlanningContext& context, const Path& path,
                  std::uint64_t checks = std::numeric_limits<std::uint64_t>::max());

}  // namespace handway::planning
