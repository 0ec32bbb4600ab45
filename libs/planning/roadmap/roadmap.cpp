#include "handway/planning/roadmap/roadmap.h"

#include "roadmap/neighbours.h"
#include "roadmap/shortest_path.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/pending/disjoint_sets.hpp>
#include <boost/property_map/vector_property_map.hpp>

#include <utility>

namespace handway::planning {

using geometric::Configuration;

namespace {

struct NodeData {
  Configuration q;
  Eigen::VectorXd coordinates;
};

using BoostGraph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, NodeData,
                                         boost::property<boost::edge_weight_t, double>>;
using Vertex = boost::graph_traits<BoostGraph>::vertex_descriptor;

}  // namespace

struct Roadmap::Graph {
  explicit Graph(const geometric::Periods& of) : periods(of), neighbours(Neighbours::kLinear, of) {}

  BoostGraph graph;
  geometric::Periods periods;
  Neighbours neighbours;
  // Property maps that grow with the graph.
  boost::vector_property_map<std::size_t> ranks;
  boost::vector_property_map<Vertex> parents;
  boost::disjoint_sets<boost::vector_property_map<std::size_t>, boost::vector_property_map<Vertex>>
      components{ranks, parents};

  [[nodiscard]] double distance(Vertex a, Vertex b) const {
    return periods.difference(graph[b].coordinates, graph[a].coordinates).norm();
  }
};

Roadmap::Roadmap(geometric::Periods periods) : graph_(std::make_unique<Graph>(periods)) {}
Roadmap::~Roadmap() = default;
Roadmap::Roadmap(Roadmap&&) noexcept = default;
Roadmap& Roadmap::operator=(Roadmap&&) noexcept = default;

int Roadmap::add_node(Configuration q, Eigen::VectorXd coordinates) {
  const auto node = node_count();
  graph_->neighbours.add(node, coordinates);
  graph_->components.make_set(
      boost::add_vertex(NodeData{std::move(q), std::move(coordinates)}, graph_->graph));
  return node;
}

void Roadmap::add_edge(int a, int b) {
  const auto first = static_cast<Vertex>(a);
  const auto second = static_cast<Vertex>(b);
  boost::add_edge(first, second, graph_->distance(first, second), graph_->graph);
  graph_->components.union_set(first, second);
}

void Roadmap::remove_edge(int a, int b) {
  boost::remove_edge(static_cast<Vertex>(a), static_cast<Vertex>(b), graph_->graph);
}

int Roadmap::node_count() const { return static_cast<int>(boost::num_vertices(graph_->graph)); }

int Roadmap::edge_count() const { return static_cast<int>(boost::num_edges(graph_->graph)); }

const Configuration& Roadmap::configuration(int node) const {
  return graph_->graph[static_cast<Vertex>(node)].q;
}

double Roadmap::distance(int a, int b) const {
  return graph_->distance(static_cast<Vertex>(a), static_cast<Vertex>(b));
}

bool Roadmap::same_component(int a, int b) const {
  return graph_->components.find_set(static_cast<Vertex>(a)) ==
         graph_->components.find_set(static_cast<Vertex>(b));
}

std::vector<int> Roadmap::nearest(int node, int k, double threshold) const {
  const auto is_other = [node](int other) { return other != node; };
  std::vector<int> nodes;
  for (const auto& [length, other] : graph_->neighbours.nearest(
           graph_->graph[static_cast<Vertex>(node)].coordinates, k, threshold, is_other)) {
    nodes.push_back(other);
  }
  return nodes;
}

std::vector<int> Roadmap::shortest_path(int from, int to) const {
  return planning::shortest_path(
      graph_->graph, from, to, boost::get(boost::edge_weight, graph_->graph),
      [&](Vertex at) { return graph_->distance(at, static_cast<Vertex>(to)); });
}

}  // namespace handway::planning
