#include "replanning/roadmap_memory.h"

#include "handway/geometric/robot/normalised_joints.h"

namespace handway::planning {

RoadmapMemory::RoadmapMemory(const LivingRoadmapSettings& limits,
                             const geometric::RobotModel& model)
    : settings(limits), graph(limits.k, geometric::normalised_turns(model)) {}

int RoadmapMemory::node_at(const PlanningProblem& problem, const Configuration& q) {
  return graph.node_at(q, geometric::normalised(problem.model(), q));
}

Freedom& RoadmapMemory::edge_between(int a, int b) {
  graph.join(a, b);
  return graph.edge(a, b);
}

void RoadmapMemory::remember(const PlanningProblem& problem, const Path& path) {
  if (graph.node_count() > settings.max_nodes) {
    graph = LivingGraph(settings.k, geometric::normalised_turns(problem.model()));
  }
  last_path = {problem.model().in_half_turns(path.waypoints)};
  int before = -1;
  for (const Configuration& q : last_path.waypoints) {
    const int node = node_at(problem, q);
    graph.node(node).set_free(changes.revision());
    if (before >= 0 && before != node) {
      edge_between(before, node).set_free(changes.revision());
    }
    before = node;
  }
}

}  // namespace handway::planning
