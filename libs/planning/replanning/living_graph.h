#pragma once

#include "handway/geometric/math/periods.h"
#include "handway/geometric/math/pose.h"
#include "replanning/scene_changes.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace handway::planning {

/// A graph of configurations whose nodes and edges remember when they were last
/// found free. Distances are Euclidean in the coordinates given with each node.
class LivingGraph {
 public:
  /// @param k edges that a new node gets, to the nearest nodes.
  /// @param periods of the coordinates.
  LivingGraph(int k, geometric::Periods periods);
  ~LivingGraph();
  LivingGraph(LivingGraph&&) noexcept;
  LivingGraph& operator=(LivingGraph&&) noexcept;

  /// The node at `q`, or whole periods from it, added if there is none; nothing is known of a new
  /// one.
  /// @returns its number, from 0 up.
  int node_at(const geometric::Configuration& q, const Eigen::VectorXd& coordinates);

  /// Adds an edge, of which nothing is known, if there is none. @pre a and b differ.
  void join(int a, int b);

  [[nodiscard]] int node_count() const;
  [[nodiscard]] int edge_count() const;
  [[nodiscard]] const geometric::Configuration& configuration(int node) const;
  [[nodiscard]] double distance(int a, int b) const;

  [[nodiscard]] Freedom& node(int node);
  /// @pre there is an edge between a and b.
  [[nodiscard]] Freedom& edge(int a, int b);

  /// Which edges a way may take.
  enum class Edges {
    kOnceFree,  ///< Those found free before.
    kAny,       ///< Others too, as if they were much longer.
  };
  /// The shortest way over what is not refused, by A*; empty if there is none.
  [[nodiscard]] std::vector<int> shortest_path(int from, int to, Edges edges,
                                               const SceneChanges& changes) const;

  /// Edges that were refused because of an object that changed since.
  [[nodiscard]] int revived_edges(const SceneChanges& changes) const;

 private:
  struct Graph;
  std::unique_ptr<Graph> graph_;
};

}  // namespace handway::planning
