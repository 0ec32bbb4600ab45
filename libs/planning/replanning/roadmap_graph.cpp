#include "replanning/roadmap_graph.h"

#include "handway/geometric/robot/normalised_joints.h"

#include <limits>
#include <utility>

namespace handway::planning {

int SceneChanges::last_change(const std::string& object) const {
  const auto found = last_change_.find(object);
  return found == last_change_.end() ? 0 : found->second;
}

std::vector<int> SceneChanges::pairs_changed_since(int revision,
                                                   const geometric::CollisionWorld& world) const {
  std::vector<int> pairs;
  for (const auto& [object, change] : last_change_) {
    if (change > revision) {
      const std::vector<int> own = world.pairs_with(object);
      pairs.insert(pairs.end(), own.begin(), own.end());
    }
  }
  return pairs;
}

RoadmapGraph::RoadmapGraph(std::shared_ptr<const geometric::RobotModel> model)
    : Roadmap(geometric::normalised_turns(*model)), model_(std::move(model)) {}

int RoadmapGraph::node_at(const Configuration& q) {
  constexpr int kJoined = 8;  // nearest nodes that a new one gets an edge to
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  const Eigen::VectorXd coordinates = geometric::normalised(*model_, q);
  const bool periodic = !periods().none();
  const double rounding = periodic ? 1e-12 : 0.0;  // of values whole periods apart
  const auto is_here = [&](int node) { return periodic || configuration(node) == q; };
  if (const auto same = neighbours().nearest(coordinates, 1, rounding, is_here); !same.empty()) {
    return same.front().second;
  }
  const int node = add_node(q, coordinates);
  for (const int other : nearest(node, kJoined, kAnywhere)) {
    edge(node, other);
  }
  return node;
}

std::vector<int> RoadmapGraph::shortest_path(int from, int to, Edges edges,
                                             const SceneChanges& changes) const {
  constexpr double kUnknownCost = 10.0;  // of an edge never checked: most are refused
  constexpr double kNotTaken = std::numeric_limits<double>::infinity();
  return Roadmap::shortest_path(
      from, to,
      [&](double length, const ValidityState& edge, const ValidityState& a,
          const ValidityState& b) {
        if (edge.is_refused(changes) || a.is_refused(changes) || b.is_refused(changes)) {
          return kNotTaken;
        }
        return edge.was_free() ? length : edges == Edges::kAny ? kUnknownCost * length : kNotTaken;
      });
}

}  // namespace handway::planning
