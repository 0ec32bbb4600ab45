#pragma once

#include "handway/planning/core/planning_context.h"
#include "replanning/roadmap_memory.h"

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace handway::planning {

/// Finds out whether ways over a living roadmap are free, asking no more than
/// what is not known, and remembers the answers.
class WayChecker {
 public:
  /// Both must outlive this object.
  WayChecker(PlanningContext& context, RoadmapMemory& memory)
      : context_(context), memory_(memory) {}

  /// The shortest free way. @param checks gives up once so many configurations are spent.
  /// @returns nodes from `from` to `to`; nothing if there is none, or when interrupted.
  [[nodiscard]] std::optional<std::vector<int>> shortest_way(int from, int to,
                                                             LivingGraph::Edges edges,
                                                             std::uint64_t checks);

  [[nodiscard]] bool node_free(int node);

  /// Of the edge between two nodes, added if need be. @pre both are free.
  [[nodiscard]] bool edge_free(int a, int b);

  /// Where the edge was found not to be free by this object, in [0, 1] from `a` to `b`.
  [[nodiscard]] std::optional<double> obstruction(int a, int b) const;

 private:
  [[nodiscard]] bool way_free(const std::vector<int>& way);
  [[nodiscard]] bool plausible(int a, int b);
  /// Of the motion from node `a` to `b`.
  [[nodiscard]] Configuration end_of(int a, int b) const;
  void refuse(Freedom& freedom, std::optional<int> pair) const;
  [[nodiscard]] std::vector<int> changed_pairs(const Freedom& freedom) const;

  PlanningContext& context_;
  RoadmapMemory& memory_;
  std::map<std::pair<int, int>, double> obstructions_;
};

}  // namespace handway::planning
