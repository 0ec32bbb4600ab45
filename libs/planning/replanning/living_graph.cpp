#include "replanning/living_graph.h"

#include "roadmap/neighbours.h"
#include "roadmap/shortest_path.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/property_map/function_property_map.hpp>

#include <limits>
#include <utility>

namespace handway::planning {
namespace {

constexpr double kUnknownCost = 10.0;  // of an edge never checked, per length: most are refused

struct NodeData {
  geometric::Configuration q;
  Eigen::VectorXd coordinates;
  Freedom freedom;
};

struct EdgeData {
  double length = 0.0;
  Freedom freedom;
};

using BoostGraph =
    boost::adjacency_list<boost::setS, boost::vecS, boost::undirectedS, NodeData, EdgeData>;
using Vertex = boost::graph_traits<BoostGraph>::vertex_descriptor;
using BoostEdge = boost::graph_traits<BoostGraph>::edge_descriptor;

Vertex vertex(int node) { return static_cast<Vertex>(node); }

}  // namespace

struct LivingGraph::Graph {
  int k;
  geometric::Periods periods;
  BoostGraph graph = {};
  Neighbours neighbours{Neighbours::kLinear, periods};

  [[nodiscard]] double distance(Vertex a, Vertex b) const {
    return periods.difference(graph[b].coordinates, graph[a].coordinates).norm();
  }

  // Infinite: not to be taken.
  [[nodiscard]] double cost(const BoostEdge& edge, Edges edges, const SceneChanges& changes) const {
    const auto refused = [&](const Freedom& freedom) { return freedom.is_refused(changes); };
    const EdgeData& data = graph[edge];
    if (refused(data.freedom) || refused(graph[boost::source(edge, graph)].freedom) ||
        refused(graph[boost::target(edge, graph)].freedom)) {
      return std::numeric_limits<double>::infinity();
    }
    if (data.freedom.was_free()) {
      return data.length;
    }
    return edges == Edges::kAny ? kUnknownCost * data.length
                                : std::numeric_limits<double>::infinity();
  }
};

LivingGraph::LivingGraph(int k, geometric::Periods periods)
    : graph_(new Graph{k, std::move(periods)}) {}
LivingGraph::~LivingGraph() = default;
LivingGraph::LivingGraph(LivingGraph&&) noexcept = default;
LivingGraph& LivingGraph::operator=(LivingGraph&&) noexcept = default;

int LivingGraph::node_at(const geometric::Configuration& q, const Eigen::VectorXd& coordinates) {
  BoostGraph& graph = graph_->graph;
  const bool periodic = !graph_->periods.none();
  const double rounding = periodic ? 1e-12 : 0.0;  // of values whole periods apart
  const auto is_here = [&](int node) { return periodic || graph[vertex(node)].q == q; };
  if (const auto same = graph_->neighbours.nearest(coordinates, 1, rounding, is_here);
      !same.empty()) {
    return same.front().second;
  }
  const Vertex added = boost::add_vertex(NodeData{q, coordinates, {}}, graph);
  for (const auto& [length, other] : graph_->neighbours.nearest(coordinates, graph_->k)) {
    boost::add_edge(added, vertex(other), EdgeData{length, {}}, graph);
  }
  const int node = static_cast<int>(added);
  graph_->neighbours.add(node, coordinates);
  return node;
}

void LivingGraph::join(int a, int b) {
  boost::add_edge(vertex(a), vertex(b), EdgeData{distance(a, b), {}}, graph_->graph);
}

int LivingGraph::node_count() const { return static_cast<int>(boost::num_vertices(graph_->graph)); }

int LivingGraph::edge_count() const { return static_cast<int>(boost::num_edges(graph_->graph)); }

const geometric::Configuration& LivingGraph::configuration(int node) const {
  return graph_->graph[vertex(node)].q;
}

double LivingGraph::distance(int a, int b) const { return graph_->distance(vertex(a), vertex(b)); }

Freedom& LivingGraph::node(int node) { return graph_->graph[vertex(node)].freedom; }

Freedom& LivingGraph::edge(int a, int b) {
  return graph_->graph[boost::edge(vertex(a), vertex(b), graph_->graph).first].freedom;
}

std::vector<int> LivingGraph::shortest_path(int from, int to, Edges edges,
                                            const SceneChanges& changes) const {
  const auto cost = boost::make_function_property_map<BoostEdge, double>(
      [&](const BoostEdge& edge) { return graph_->cost(edge, edges, changes); });
  return planning::shortest_path(graph_->graph, from, to, cost,
                                 [&](Vertex at) { return graph_->distance(at, vertex(to)); });
}

int LivingGraph::revived_edges(const SceneChanges& changes) const {
  int revived = 0;
  const BoostGraph& graph = graph_->graph;
  for (auto [edge, end] = boost::edges(graph); edge != end; ++edge) {
    const Freedom& freedom = graph[*edge].freedom;
    revived += freedom.refused_at != Freedom::kNever && !freedom.is_refused(changes) ? 1 : 0;
  }
  return revived;
}

}  // namespace handway::planning
