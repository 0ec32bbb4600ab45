#pragma once

#include "handway/planning/core/planning_context.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

namespace handway::planning {

/// Edges of the roadmap that smooths a path.
enum class SmoothingEdges {
  kForwards,  ///< From nodes of the path to later ones.
  kBothWays,  ///< Both directions, as printed: an edge of a roadmap has none.
};

/// The paper's smoothing (section 5.3, FINDPATH): "a new (small) roadmap composed of the nodes of
/// the path and all collision-free edges between them", and its shortest path. If interrupted, it
/// returns the best path known by then.
/// @pre every edge of `path` is free.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Path smooth_by_roadmap(
    PlanningContext& context, const Path& path, SmoothingEdges edges = SmoothingEdges::kForwards);

}  // namespace handway::planning
