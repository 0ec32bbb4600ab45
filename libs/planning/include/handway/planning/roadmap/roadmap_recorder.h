#pragma once

#include "handway/planning/core/observer.h"
#include "handway/planning/export.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace handway::planning {

/// The nodes and edges that a run found, independent of the planner.
struct HANDWAY_PLANNING_EXPORT RecordedRoadmap {
  /// A node of the roadmap.
  struct Node {
    geometric::Configuration q;
    int pmd_count = 0;   ///< Principal directions used for the sample; 0: none.
    double step = 0.0;   ///< Value of NodeEvent::step.
    double rho_a = 0.0;  ///< Half-side of the region it was sampled from.
    int search = 0;      ///< Number of the search that found it.
  };
  using Edge = std::pair<int, int>;  ///< Indices of nodes.

  std::vector<Node> nodes;
  std::vector<Edge> edges;
  std::optional<int> winner;                         ///< The search that gave the path, of several.
  std::pair<double, double> search_range{0.0, 1.0};  ///< [d_ini, d_goal], the last one reported.
  std::uint64_t left_out = 0;                        ///< Nodes beyond the recorder's limit.

  /// The winner's nodes and edges alone; all without a winner.
  [[nodiscard]] RecordedRoadmap of_winner() const;
};

/// Records the roadmap of a run, and forwards its events, with nodes by their place among all
/// nodes. Of runs with more nodes than it keeps, it has the first. A number that comes again
/// belongs to another search's node from then on.
class HANDWAY_PLANNING_EXPORT RoadmapRecorder : public Observer {
 public:
  /// @param most_nodes limit of the nodes. @param next may be null; outlives this.
  explicit RoadmapRecorder(std::size_t most_nodes, Observer* next = nullptr);

  [[nodiscard]] const RecordedRoadmap& roadmap() const { return roadmap_; }

  void on_node(const NodeEvent& node) override;
  void on_edge(int from, int to) override;
  void on_winner(int search) override;
  void on_search_range(double d_ini, double d_goal) override;
  void on_path(const Path& path) override { next_.on_path(path); }
  void on_progress(double fraction, std::string_view activity) override {
    next_.on_progress(fraction, activity);
  }
  [[nodiscard]] AlgorithmObserver* algorithm() override { return next_.algorithm(); }

 private:
  std::size_t most_nodes_;
  Observer& next_;
  std::unordered_map<int, int> places_;  ///< Index of each node number.
  RecordedRoadmap roadmap_;
};

}  // namespace handway::planning
