#pragma once

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/astar_search.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <vector>

namespace handway::planning {

namespace shortest_path_detail {

struct GoalReached {};

class StopAtGoal : public boost::default_astar_visitor {
 public:
  explicit StopAtGoal(std::size_t goal) : goal_(goal) {}
  template <typename Graph>
  void examine_vertex(std::size_t vertex, const Graph& /*graph*/) const {
    if (vertex == goal_) {
      throw GoalReached{};  // how Boost Graph ends a search early
    }
  }

 private:
  std::size_t goal_;
};

}  // namespace shortest_path_detail

/// The shortest path from node `from` to node `to` by A*, both included; empty if there is none.
/// @param graph a boost::adjacency_list whose nodes are numbered from 0 up.
/// @param weights property map from its edges to lengths ≥ 0; infinite: not to be taken.
/// @param distance_to_goal never more than the length of a path from a node to `to`.
template <typename Graph, typename Weights, typename Heuristic>
[[nodiscard]] std::vector<int> shortest_path(const Graph& graph, int from, int to,
                                             const Weights& weights,
                                             const Heuristic& distance_to_goal) {
  const auto goal = static_cast<std::size_t>(to);
  std::vector<std::size_t> previous(boost::num_vertices(graph));
  try {
    boost::astar_search(
        graph, static_cast<std::size_t>(from), distance_to_goal,
        boost::predecessor_map(boost::make_iterator_property_map(
                                   previous.begin(), boost::get(boost::vertex_index, graph)))
            .weight_map(weights)
            .visitor(shortest_path_detail::StopAtGoal(goal)));
    return {};
  } catch (const shortest_path_detail::GoalReached&) {
  }
  if (from != to && previous[goal] == goal) {
    return {};  // Boost Graph visits what only infinite lengths lead to as well
  }
  std::vector<int> path{to};
  while (path.back() != from) {
    path.push_back(static_cast<int>(previous[static_cast<std::size_t>(path.back())]));
  }
  std::ranges::reverse(path);
  return path;
}

}  // namespace handway::planning
