#include "handway/planning/roadmap/roadmap_recorder.h"

namespace handway::planning {

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

void RoadmapRecorder::on_node(const NodeEvent& node) {
  if (roadmap_.nodes.size() >= most_nodes_) {
    ++roadmap_.left_out;
    return;
  }
  index_[node.id] = static_cast<int>(roadmap_.nodes.size());
  roadmap_.nodes.push_back({node.q, node.pmd_count, node.rho_a, node.search});
}

void RoadmapRecorder::on_edge(int from, int to) {
  const auto a = index_.find(from);
  const auto b = index_.find(to);
  if (a != index_.end() && b != index_.end()) {
    roadmap_.edges.emplace_back(a->second, b->second);
  }
}

}  // namespace handway::planning
