#include "roadmap/lazy_roadmap.h"

#include "roadmap/nearest_nodes.h"
#include "roadmap/shortest_path.h"

#include <boost/graph/adjacency_list.hpp>

#include <utility>

namespace handway::planning {
namespace {

struct NodeData {
  geometric::Configuration q;
  Eigen::VectorXd coordinates;
};

struct EdgeData {
  double length = 0.0;
  bool certain = false;
};

using BoostGraph =
    boost::adjacency_list<boost::setS, boost::vecS, boost::undirectedS, NodeData, EdgeData>;
using Vertex = boost::graph_traits<BoostGraph>::vertex_descriptor;

Vertex vertex(int node) { return static_cast<Vertex>(node); }

}  // namespace

struct LazyRoadmap::Graph {
  int k;
  BoostGraph graph;

  [[nodiscard]] double distance(Vertex a, Vertex b) const {
    return (graph[a].coordinates - graph[b].coordinates).norm();
  }
};

LazyRoadmap::LazyRoadmap(int k) : graph_(std::make_unique<Graph>(Graph{k, {}})) {}
LazyRoadmap::~LazyRoadmap() = default;
LazyRoadmap::LazyRoadmap(LazyRoadmap&&) noexcept = default;
LazyRoadmap& LazyRoadmap::operator=(LazyRoadmap&&) noexcept = default;

int LazyRoadmap::add_node(geometric::Configuration q, const Eigen::VectorXd& coordinates) {
  BoostGraph& graph = graph_->graph;
  const Vertex added = boost::add_vertex(NodeData{std::move(q), coordinates}, graph);
  std::vector<NodeDistance> others;
  for (Vertex other = 0; other < added; ++other) {
    others.emplace_back(graph_->distance(added, other), other);
  }
  const std::vector<NodeDistance> nearest = nearest_nodes(std::move(others), graph_->k);
  for (const auto& [length, other] : nearest) {
    boost::add_edge(added, vertex(other), EdgeData{length, false}, graph);
  }
  return static_cast<int>(added);
}

int LazyRoadmap::node_count() const { return static_cast<int>(boost::num_vertices(graph_->graph)); }

const geometric::Configuration& LazyRoadmap::configuration(int node) const {
  return graph_->graph[vertex(node)].q;
}

double LazyRoadmap::distance(int a, int b) const { return graph_->distance(vertex(a), vertex(b)); }

std::vector<int> LazyRoadmap::shortest_path(int from, int to) const {
  return planning::shortest_path(graph_->graph, from, to,
                                 boost::get(&EdgeData::length, graph_->graph),
                                 [&](Vertex at) { return graph_->distance(at, vertex(to)); });
}

bool LazyRoadmap::is_certain(int a, int b) const {
  return graph_->graph[boost::edge(vertex(a), vertex(b), graph_->graph).first].certain;
}

void LazyRoadmap::confirm_edge(int a, int b) {
  graph_->graph[boost::edge(vertex(a), vertex(b), graph_->graph).first].certain = true;
}

void LazyRoadmap::remove_edge(int a, int b) {
  boost::remove_edge(vertex(a), vertex(b), graph_->graph);
}

}  // namespace handway::planning
