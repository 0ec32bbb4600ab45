#include "roadmap/lazy_roadmap.h"

#include "roadmap/nearest_nodes.h"
#include "roadmap/shortest_path.h"

#include <boost/graph/adjacency_list.hpp>

#include <utility>

namespace handway::planning {
namespace {

struct LazyNode {
  geometric::Configuration q;
  Eigen::VectorXd coordinates;
};

struct LazyEdge {
  double length = 0.0;
  bool certain = false;
};

using LazyGraph =
    boost::adjacency_list<boost::setS, boost::vecS, boost::undirectedS, LazyNode, LazyEdge>;
using LazyVertex = boost::graph_traits<LazyGraph>::vertex_descriptor;

LazyVertex lazy_vertex(int node) { return static_cast<LazyVertex>(node); }

}  // namespace

struct LazyRoadmap::Graph {
  int k;
  LazyGraph graph;

  [[nodiscard]] double distance(LazyVertex a, LazyVertex b) const {
    return (graph[a].coordinates - graph[b].coordinates).norm();
  }
};

LazyRoadmap::LazyRoadmap(int k) : graph_(std::make_unique<Graph>(Graph{k, {}})) {}
LazyRoadmap::~LazyRoadmap() = default;
LazyRoadmap::LazyRoadmap(LazyRoadmap&&) noexcept = default;
LazyRoadmap& LazyRoadmap::operator=(LazyRoadmap&&) noexcept = default;

int LazyRoadmap::add_node(geometric::Configuration q, const Eigen::VectorXd& coordinates) {
  LazyGraph& graph = graph_->graph;
  const LazyVertex added = boost::add_vertex(LazyNode{std::move(q), coordinates}, graph);
  std::vector<NodeDistance> others;
  others.reserve(added);
  for (LazyVertex other = 0; other < added; ++other) {
    others.emplace_back(graph_->distance(added, other), other);
  }
  const std::vector<NodeDistance> nearest = nearest_nodes(std::move(others), graph_->k);
  for (const auto& [length, other] : nearest) {
    boost::add_edge(added, lazy_vertex(other), LazyEdge{length, false}, graph);
  }
  return static_cast<int>(added);
}

int LazyRoadmap::node_count() const { return static_cast<int>(boost::num_vertices(graph_->graph)); }

const geometric::Configuration& LazyRoadmap::configuration(int node) const {
  return graph_->graph[lazy_vertex(node)].q;
}

double LazyRoadmap::distance(int a, int b) const {
  return graph_->distance(lazy_vertex(a), lazy_vertex(b));
}

std::vector<int> LazyRoadmap::shortest_path(int from, int to) const {
  return planning::shortest_path(
      graph_->graph, from, to, boost::get(&LazyEdge::length, graph_->graph),
      [&](LazyVertex at) { return graph_->distance(at, lazy_vertex(to)); });
}

bool LazyRoadmap::is_certain(int a, int b) const {
  return graph_->graph[boost::edge(lazy_vertex(a), lazy_vertex(b), graph_->graph).first].certain;
}

void LazyRoadmap::confirm_edge(int a, int b) {
  graph_->graph[boost::edge(lazy_vertex(a), lazy_vertex(b), graph_->graph).first].certain = true;
}

void LazyRoadmap::remove_edge(int a, int b) {
  boost::remove_edge(lazy_vertex(a), lazy_vertex(b), graph_->graph);
}

}  // namespace handway::planning
