#include "handway/planning/paths/roadmap_smoothing.h"

#include "handway/planning/core/objective.h"
#include "paths/subspace_roadmap.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

namespace handway::planning {

Path smooth_by_roadmap(PlanningContext& context, const Path& path, SmoothingEdges edges) {
  Objective length(context.problem(), {});
  std::vector<Objective::Point> points;
  std::ranges::transform(path.waypoints, std::back_inserter(points),
                         [&](const Configuration& q) { return length.point(q); });
  Path smooth;
  constexpr std::uint64_t kAllChecks = std::numeric_limits<std::uint64_t>::max();
  SubspaceRoadmap roadmap(context, length, points, false, 0, edges == SmoothingEdges::kBothWays);
  std::ranges::transform(roadmap.cheapest_path(kAllChecks), std::back_inserter(smooth.waypoints),
                         &Objective::Point::q);
  return smooth;
}

}  // namespace handway::planning
