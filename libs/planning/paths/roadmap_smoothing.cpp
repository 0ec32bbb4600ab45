#include "handway/planning/paths/roadmap_smoothing.h"

#include "handway/planning/core/objective.h"
#include "paths/subspace_roadmap.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace handway::planning {

Path smooth_by_roadmap(PlanningContext& context, const Path& path, std::uint64_t checks) {
  Objective length(context.problem(), {});
  std::vector<Objective::Point> points;
  std::ranges::transform(path.waypoints, std::back_inserter(points),
                         [&](const Configuration& q) { return length.point(q); });
  Path smooth;
  std::ranges::transform(SubspaceRoadmap(context, length, points, false, 0).cheapest_path(checks),
                         std::back_inserter(smooth.waypoints), &Objective::Point::q);
  return smooth;
}

}  // namespace handway::planning
