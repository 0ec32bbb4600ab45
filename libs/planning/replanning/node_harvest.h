#pragma once

#include "handway/planning/core/observer.h"
#include "handway/planning/core/planning_problem.h"

#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace handway::planning {

struct RoadmapMemory;

/// Keeps the nodes and edges that searches tell of, and passes on to another observer
/// what it observes, with numbers that differ from search to search.
class NodeHarvest final : public Observer {
 public:
  explicit NodeHarvest(Observer& listener) : listener_(listener) {}

  /// Events from now on are of another search, whose numbers start again.
  void begin_search();

  /// Adds what was observed to the roadmap, as nodes and edges of which nothing is certain.
  void bring_in(const PlanningProblem& problem, RoadmapMemory& memory) const;

  void on_node(const NodeEvent& node) override;
  void on_edge(int from, int to) override;
  void on_winner(int search) override;
  void on_search_range(double d_ini, double d_goal) override;
  void on_progress(double fraction, std::string_view activity) override;

 private:
  Observer& listener_;
  std::map<int, int> numbers_;  ///< Of this search's nodes, among all.
  std::vector<Configuration> nodes_;
  std::vector<std::pair<int, int>> edges_;
};

}  // namespace handway::planning
