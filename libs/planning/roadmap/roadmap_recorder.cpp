#include "handway/planning/roadmap/roadmap_recorder.h"

#include <algorithm>
#include <utility>

namespace handway::planning {
namespace {

Observer& nobody() {
  static Observer observer;
  return observer;
}

}  // namespace

RecordedRoadmap RecordedRoadmap::of_winner() const {
  if (!winner) {
    return *this;
  }
  RecordedRoadmap result;
  result.winner = winner;
  result.search_range = search_range;
  result.left_out = left_out;
  std::vector<int> index(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].search == *winner) {
      index[i] = static_cast<int>(result.nodes.size());
      result.nodes.push_back(nodes[i]);
    }
  }
  for (const auto& [from, to] : edges) {
    const Edge edge{index[static_cast<std::size_t>(from)], index[static_cast<std::size_t>(to)]};
    if (edge.first >= 0 && edge.second >= 0) {
      result.edges.push_back(edge);
    }
  }
  return result;
}

RoadmapRecorder::RoadmapRecorder(std::size_t most_nodes, Observer* next)
    : most_nodes_(most_nodes), next_(next ? *next : nobody()) {}

void RoadmapRecorder::on_node(const NodeEvent& node) {
  NodeEvent placed = node;
  placed.id = static_cast<int>(roadmap_.nodes.size() + roadmap_.left_out);
  places_[node.id] = placed.id;
  if (roadmap_.nodes.size() < most_nodes_) {
    roadmap_.nodes.push_back({node.q, node.pmd_count, node.step, node.rho_a, node.search});
  } else {
    ++roadmap_.left_out;
  }
  next_.on_node(placed);
}

void RoadmapRecorder::on_edge(int from, int to) {
  const auto a = places_.find(from);
  const auto b = places_.find(to);
  if (a == places_.end() || b == places_.end()) {
    return;
  }
  if (std::cmp_less(std::max(a->second, b->second), roadmap_.nodes.size())) {
    roadmap_.edges.emplace_back(a->second, b->second);
  }
  next_.on_edge(a->second, b->second);
}

void RoadmapRecorder::on_winner(int search) {
  roadmap_.winner = search;
  next_.on_winner(search);
}

void RoadmapRecorder::on_search_range(double d_ini, double d_goal) {
  roadmap_.search_range = {d_ini, d_goal};
  next_.on_search_range(d_ini, d_goal);
}

}  // namespace handway::planning
