#include "replanning/node_harvest.h"

#include "replanning/roadmap_memory.h"

namespace handway::planning {

void NodeHarvest::begin_search() { numbers_.clear(); }

void NodeHarvest::on_node(const NodeEvent& node) {
  const int number = static_cast<int>(nodes_.size());
  numbers_[node.id] = number;
  nodes_.push_back(node.q);
  listener_.on_node({number, node.q, node.pmd_count, node.step, node.rho_a, node.search});
}

void NodeHarvest::on_edge(int from, int to) {
  edges_.emplace_back(numbers_.at(from), numbers_.at(to));
  listener_.on_edge(edges_.back().first, edges_.back().second);
}

void NodeHarvest::on_winner(int search) { listener_.on_winner(search); }

void NodeHarvest::on_search_range(double d_ini, double d_goal) {
  listener_.on_search_range(d_ini, d_goal);
}

void NodeHarvest::on_progress(double fraction, std::string_view activity) {
  listener_.on_progress(fraction, activity);
}

void NodeHarvest::bring_in(const PlanningProblem& problem, RoadmapMemory& memory) const {
  std::vector<int> numbers;
  for (const Configuration& q : nodes_) {
    if (memory.graph.node_count() >= memory.settings.max_nodes) {
      break;
    }
    numbers.push_back(memory.node_at(problem, q));
  }
  const int count = static_cast<int>(numbers.size());
  for (const auto& [from, to] : edges_) {
    const int a = from < count ? numbers[static_cast<std::size_t>(from)] : -1;
    const int b = to < count ? numbers[static_cast<std::size_t>(to)] : -1;
    if (a >= 0 && b >= 0 && a != b) {
      memory.graph.join(a, b);
    }
  }
}

}  // namespace handway::planning
