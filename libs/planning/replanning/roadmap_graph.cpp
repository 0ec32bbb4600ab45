#include "replanning/roadmap_graph.h"

#include "handway/geometric/robot/normalised_joints.h"
#include "roadmap/shortest_path.h"

#include <boost/property_map/function_property_map.hpp>

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
    : model_(std::move(model)),
      periods_(geometric::normalised_turns(*model_)),
      neighbours_(Neighbours::kLinear, periods_) {}

int RoadmapGraph::node_at(const Configuration& q) {
  constexpr int kJoined = 8;  // nearest nodes that a new one gets an edge to
  const Eigen::VectorXd coordinates = geometric::normalised(*model_, q);
  const bool periodic = !periods_.none();
  const double rounding = periodic ? 1e-12 : 0.0;  // of values whole periods apart
  const auto is_here = [&](int node) { return periodic || configuration(node) == q; };
  if (const auto same = neighbours_.nearest(coordinates, 1, rounding, is_here); !same.empty()) {
    return same.front().second;
  }
  const auto added = boost::add_vertex(Node{q, coordinates}, graph_);
  for (const auto& [length, other] : neighbours_.nearest(coordinates, kJoined)) {
    boost::add_edge(added, at(other), Edge{length}, graph_);
  }
  const int node = static_cast<int>(added);
  neighbours_.add(node, coordinates);
  return node;
}

double RoadmapGraph::distance(int a, int b) const {
  return periods_.difference(graph_[at(b)].coordinates, graph_[at(a)].coordinates).norm();
}

ValidityState& RoadmapGraph::edge(int a, int b) {
  return graph_[boost::add_edge(at(a), at(b), Edge{distance(a, b)}, graph_).first].validity;
}

// Infinite: not to be taken.
double RoadmapGraph::cost(const Graph::edge_descriptor& edge, Edges edges,
                          const SceneChanges& changes) const {
  constexpr double kUnknownCost = 10.0;  // of an edge never checked: most are refused
  constexpr double kNotTaken = std::numeric_limits<double>::infinity();
  const Edge& data = graph_[edge];
  if (data.validity.is_refused(changes) ||
      graph_[boost::source(edge, graph_)].validity.is_refused(changes) ||
      graph_[boost::target(edge, graph_)].validity.is_refused(changes)) {
    return kNotTaken;
  }
  if (data.validity.was_free()) {
    return data.length;
  }
  return edges == Edges::kAny ? kUnknownCost * data.length : kNotTaken;
}

std::vector<int> RoadmapGraph::shortest_path(int from, int to, Edges edges,
                                             const SceneChanges& changes) const {
  const auto costs = boost::make_function_property_map<Graph::edge_descriptor, double>(
      [&](const Graph::edge_descriptor& edge) { return cost(edge, edges, changes); });
  return planning::shortest_path(graph_, from, to, costs,
                                 [&](auto node) { return distance(static_cast<int>(node), to); });
}

}  // namespace handway::planning
