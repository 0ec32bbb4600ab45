#pragma once

#include "handway/planning/core/observer.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/core/planning_problem.h"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace handway::planning {

/// Watches how far searches come from both ends, for another observer to watch, too.
///
/// The first node of each search is taken for its start, the second for its goal.
class ReachObserver final : public Observer {
 public:
  /// Both outlive this.
  ReachObserver(const PlanningProblem& problem, Observer& next);

  void on_node(const NodeEvent& node) override;
  void on_edge(int from, int to) override;
  void on_winner(int search) override { next_.on_winner(search); }
  void on_search_range(double d_ini, double d_goal) override {
    next_.on_search_range(d_ini, d_goal);
  }
  void on_path(const Path& path) override { next_.on_path(path); }
  void on_progress(double fraction, std::string_view activity) override {
    next_.on_progress(fraction, activity);
  }

  [[nodiscard]] AlgorithmObserver* algorithm() override { return next_.algorithm(); }

  /// Of all searches together, the farthest; nothing if no search has both ends.
  [[nodiscard]] std::optional<SearchReach> reach() const;

 private:
  /// Connected nodes; of a component whose root is another's child only `parent` counts.
  struct Component {
    int parent;
    double first;  ///< Least progress along the straight motion.
    double last;   ///< Most.
    std::shared_ptr<const geometric::Configuration> first_q;  ///< Where that is; null in a child.
    std::shared_ptr<const geometric::Configuration> last_q;
    std::uint64_t nodes = 1;
  };

  [[nodiscard]] int root(int node) const;

  Observer& next_;
  const PlanningProblem& problem_;
  mutable std::map<int, Component> components_;  ///< By node.
  std::map<int, std::vector<int>> ends_;         ///< By search: start, goal.
};

}  // namespace handway::planning
