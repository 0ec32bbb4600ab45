#pragma once

#include "handway/planning/core/observer.h"

#include <utility>
#include <variant>
#include <vector>

namespace handway::planning {

/// Keeps the events of a search, to replay them later.
class EventLog final : public Observer {
 public:
  void on_node(const NodeEvent& node) override;
  void on_edge(int from, int to) override;

  /// Tells `observer` what came since the last time. Node n gets the number
  /// `stride` * n + `offset`, so that several searches' nodes differ, and is said to be of
  /// search `offset`.
  void replay(Observer& observer, int offset, int stride);

 private:
  struct Node {
    int id;
    geometric::Configuration q;
    int pmd_count;
    double step;
    double rho_a;
  };
  using Edge = std::pair<int, int>;

  std::vector<std::variant<Node, Edge>> events_;
};

}  // namespace handway::planning
