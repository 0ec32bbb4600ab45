#include "handway/planning/paths/roadmap_smoothing.h"

#include "handway/geometric/robot/normalised_joints.h"
#include "handway/planning/roadmap/roadmap.h"

namespace handway::planning {

Path smooth_by_roadmap(PlanningContext& context, const Path& path) {
  const int count = static_cast<int>(path.waypoints.size());
  Roadmap roadmap;
  for (const Configuration& q : path.waypoints) {
    roadmap.add_node(q, geometric::normalised(context.problem().model(), q));
  }
  for (int i = 0; i + 1 < count; ++i) {
    roadmap.add_edge(i, i + 1);
  }
  for (int span = count - 1; span >= 2; --span) {
    for (int i = 0; i + span < count && !context.interruption(); ++i) {
      if (context.edge_free(roadmap.configuration(i), roadmap.configuration(i + span))) {
        roadmap.add_edge(i, i + span);
      }
    }
  }
  Path smooth;
  for (const int node : roadmap.shortest_path(0, count - 1)) {
    smooth.waypoints.push_back(roadmap.configuration(node));
  }
  return smooth;
}

}  // namespace handway::planning
