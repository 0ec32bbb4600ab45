#pragma once

#include "handway/geometric/math/pose.h"
#include "roadmap/neighbours.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/astar_search.hpp>
#include <boost/pending/disjoint_sets.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/vector_property_map.hpp>

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

namespace handway::planning {

/// A graph of configurations whose connected components are known at all times
/// (the paper's G with ADDNODE, ADDEDGE, SAMECOMPONENT and UPDATE). Nodes are numbered from 0 up.
///
/// Distances are Euclidean in the coordinates given with each node: joints
/// normalised to [0, 1] (paper, section 7).
/// @tparam Data data of a node or an edge.
template <typename Data = std::monostate>
class Roadmap {
 public:
  /// @param periods of the coordinates.
  explicit Roadmap(geometric::Periods periods = {})
      : periods_(std::move(periods)), neighbours_(Neighbours::kLinear, periods_) {}

  /// @param coordinates its place for distances. @returns the node's number.
  int add_node(geometric::Configuration q, Eigen::VectorXd coordinates) {
    const int node = node_count();
    neighbours_.add(node, coordinates);
    components_.make_set(boost::add_vertex({std::move(q), std::move(coordinates), {}}, graph_));
    return node;
  }

  [[nodiscard]] int node_count() const { return static_cast<int>(boost::num_vertices(graph_)); }
  [[nodiscard]] int edge_count() const { return static_cast<int>(boost::num_edges(graph_)); }
  [[nodiscard]] const geometric::Configuration& configuration(int node) const {
    return graph_[at(node)].q;
  }
  [[nodiscard]] Data& node(int node) { return graph_[at(node)].data; }
  /// Returns the data of the undirected edge between two nodes, added if needed. @pre a ≠ b.
  Data& edge(int a, int b) {
    const auto [edge, is_new] = boost::add_edge(at(a), at(b), {distance(a, b), {}}, graph_);
    if (is_new) {
      components_.union_set(at(a), at(b));
    }
    return graph_[edge].data;
  }
  /// Removes an edge; the components don't change.
  void remove_edge(int a, int b) { boost::remove_edge(at(a), at(b), graph_); }

  [[nodiscard]] double distance(int a, int b) const {
    return periods_.difference(graph_[at(b)].coordinates, graph_[at(a)].coordinates).norm();
  }
  [[nodiscard]] bool same_component(int a, int b) const {
    return components_.find_set(at(a)) == components_.find_set(at(b));
  }

  /// Up to `k` nodes nearest to `node`, itself left out, none farther than
  /// `threshold`, nearest first.
  [[nodiscard]] std::vector<int> nearest(int node, int k, double threshold) const {
    std::vector<int> nodes;
    for (const auto& [length, other] : neighbours_.nearest(
             graph_[at(node)].coordinates, k, threshold, [&](int n) { return n != node; })) {
      nodes.push_back(other);
    }
    return nodes;
  }

  /// FINDPATH's search: the shortest path by A*, both ends included; empty without a path.
  [[nodiscard]] std::vector<int> shortest_path(int from, int to) const {
    return shortest_path(from, to, [](double length, auto&&...) { return length; });
  }

 protected:
  /// @param cost of an edge, never less than its length; infinite: forbidden. Called with its
  /// length, its data and those of its ends.
  template <typename Cost>
  [[nodiscard]] std::vector<int> shortest_path(int from, int to, const Cost& cost) const {
    const auto costs = boost::make_function_property_map<EdgeNumber, double>([&](EdgeNumber edge) {
      return cost(graph_[edge].length, graph_[edge].data, graph_[source(edge, graph_)].data,
                  graph_[target(edge, graph_)].data);
    });
    std::vector<std::size_t> previous(boost::num_vertices(graph_));
    try {
      boost::astar_search(
          graph_, at(from), [&](std::size_t node) { return distance(static_cast<int>(node), to); },
          boost::predecessor_map(boost::make_iterator_property_map(
                                     previous.begin(), boost::get(boost::vertex_index, graph_)))
              .weight_map(costs)
              .visitor(StopAt{{}, at(to)}));
      return {};
    } catch (const Reached&) {
    }
    if (from != to && previous[at(to)] == at(to)) {
      return {};  // Boost Graph visits what only infinite lengths lead to as well
    }
    std::vector<int> path{to};
    while (path.back() != from) {
      path.push_back(static_cast<int>(previous[at(path.back())]));
    }
    std::ranges::reverse(path);
    return path;
  }

  [[nodiscard]] const geometric::Periods& periods() const { return periods_; }
  [[nodiscard]] const Neighbours& neighbours() const { return neighbours_; }

 private:
  struct Node {
    geometric::Configuration q;
    Eigen::VectorXd coordinates;
    Data data;
  };
  struct Edge {
    double length;
    Data data;
  };
  using Graph = boost::adjacency_list<boost::setS, boost::vecS, boost::undirectedS, Node, Edge>;
  using EdgeNumber = typename Graph::edge_descriptor;

  struct Reached {};
  struct StopAt : boost::default_astar_visitor {
    std::size_t goal;

    void examine_vertex(std::size_t vertex, const Graph& /*graph*/) const {
      if (vertex == goal) {
        throw Reached{};  // how Boost Graph ends a search early
      }
    }
  };

  [[nodiscard]] static std::size_t at(int node) { return static_cast<std::size_t>(node); }

  Graph graph_;
  geometric::Periods periods_;
  Neighbours neighbours_;
  // Property maps that grow with the graph.
  boost::vector_property_map<std::size_t> ranks_;
  boost::vector_property_map<std::size_t> parents_;
  mutable boost::disjoint_sets<boost::vector_property_map<std::size_t>,
                               boost::vector_property_map<std::size_t>>
      components_{ranks_, parents_};
};

}  // namespace handway::planning
