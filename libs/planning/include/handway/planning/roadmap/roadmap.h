#pragma once

#include "handway/geometric/math/periods.h"
#include "handway/geometric/math/pose.h"
#include "handway/planning/export.h"

#include <memory>
#include <vector>

namespace handway::planning {

/// A graph of configurations whose connected components are known at all times
/// (the paper's G with ADDNODE, ADDEDGE, SAMECOMPONENT and UPDATE).
///
/// Distances are Euclidean in the coordinates given with each node: joints
/// normalised to [0, 1] (paper, section 7).
class HANDWAY_PLANNING_EXPORT Roadmap {
 public:
  /// @param periods of the coordinates.
  explicit Roadmap(geometric::Periods periods = {});
  ~Roadmap();
  Roadmap(Roadmap&&) noexcept;
  Roadmap& operator=(Roadmap&&) noexcept;

  /// @param q configuration. @param coordinates where it lies for distances.
  /// @returns the node's number, from 0 up.
  int add_node(geometric::Configuration q, Eigen::VectorXd coordinates);

  /// Adds an undirected edge weighted by the distance of its ends.
  void add_edge(int a, int b);

  /// @pre there is an edge between a and b. Their component stays one.
  void remove_edge(int a, int b);

  [[nodiscard]] int node_count() const;
  [[nodiscard]] int edge_count() const;
  [[nodiscard]] const geometric::Configuration& configuration(int node) const;
  [[nodiscard]] double distance(int a, int b) const;
  [[nodiscard]] bool same_component(int a, int b) const;

  /// Up to `k` nodes nearest to `node`, itself left out, none farther than
  /// `threshold`, nearest first.
  [[nodiscard]] std::vector<int> nearest(int node, int k, double threshold) const;

  /// FINDPATH's search: the shortest path by A*, empty if there is none.
  [[nodiscard]] std::vector<int> shortest_path(int from, int to) const;

 private:
  struct Graph;
  std::unique_ptr<Graph> graph_;
};

}  // namespace handway::planning
