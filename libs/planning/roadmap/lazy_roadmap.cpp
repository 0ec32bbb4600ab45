#include "roadmap/lazy_roadmap.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/astar_search.hpp>

#include <algorithm>
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

struct GoalReached {};

class StopAtGoal : public boost::default_astar_visitor {
 public:
  explicit StopAtGoal(Vertex goal) : goal_(goal) {}
  void examine_vertex(Vertex vertex, const BoostGraph& /*graph*/) const {
    if (vertex == goal_) {
      throw GoalReached{};  // how Boost Graph ends a search early
    }
  }

 private:
  Vertex goal_;
};

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
  std::vector<std::pair<double, Vertex>> others;
  for (Vertex other = 0; other < added; ++other) {
    others.emplace_back(graph_->distance(added, other), other);
  }
  const auto count =
      std::min(static_cast<std::ptrdiff_t>(graph_->k), static_cast<std::ptrdiff_t>(others.size()));
  std::partial_sort(others.begin(), others.begin() + count, others.end());
  for (auto other = others.begin(); other != others.begin() + count; ++other) {
    boost::add_edge(added, other->second, EdgeData{other->first, false}, graph);
  }
  return static_cast<int>(added);
}

int LazyRoadmap::node_count() const { return static_cast<int>(boost::num_vertices(graph_->graph)); }

const geometric::Configuration& LazyRoadmap::configuration(int node) const {
  return graph_->graph[vertex(node)].q;
}

double LazyRoadmap::distance(int a, int b) const { return graph_->distance(vertex(a), vertex(b)); }

std::vector<int> LazyRoadmap::shortest_path(int from, int to) const {
  const BoostGraph& graph = graph_->graph;
  std::vector<Vertex> previous(boost::num_vertices(graph));
  try {
    boost::astar_search(
        graph, vertex(from), [&](Vertex at) { return graph_->distance(at, vertex(to)); },
        boost::predecessor_map(boost::make_iterator_property_map(
                                   previous.begin(), boost::get(boost::vertex_index, graph)))
            .weight_map(boost::get(&EdgeData::length, graph))
            .visitor(StopAtGoal(vertex(to))));
    return {};
  } catch (const GoalReached&) {
  }
  std::vector<int> path{to};
  while (path.back() != from) {
    path.push_back(static_cast<int>(previous[vertex(path.back())]));
  }
  std::ranges::reverse(path);
  return path;
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
