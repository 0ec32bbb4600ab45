#include "planners/event_log.h"

namespace handway::planning {

void EventLog::on_node(const NodeEvent& node) {
  events_.emplace_back(Node{node.id, node.q, node.pmd_count, node.step, node.rho_a});
}

void EventLog::on_edge(int from, int to) { events_.emplace_back(Edge{from, to}); }

void EventLog::replay(Observer& observer, int offset, int stride) {
  for (const auto& event : events_) {
    if (const auto* node = std::get_if<Node>(&event)) {
      observer.on_node(
          {stride * node->id + offset, node->q, node->pmd_count, node->step, node->rho_a, offset});
    } else {
      const auto& [from, to] = std::get<Edge>(event);
      observer.on_edge(stride * from + offset, stride * to + offset);
    }
  }
  events_.clear();
}

}  // namespace handway::planning
