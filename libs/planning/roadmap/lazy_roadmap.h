#pragma once

#include "handway/geometric/math/pose.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace handway::planning {

/// A graph of free configurations whose edges are taken as free until found not
/// to be. Distances are Euclidean in the coordinates given with each node.
///
/// Source: Bohlin, Kavraki, "Path planning using lazy PRM", ICRA 2000,
/// doi:10.1109/ROBOT.2000.844107.
class LazyRoadmap {
 public:
  /// @param k edges that a new node gets, to the nearest nodes.
  explicit LazyRoadmap(int k);
  ~LazyRoadmap();
  LazyRoadmap(LazyRoadmap&&) noexcept;
  LazyRoadmap& operator=(LazyRoadmap&&) noexcept;

  /// @returns the node's number, from 0 up.
  int add_node(geometric::Configuration q, const Eigen::VectorXd& coordinates);

  [[nodiscard]] int node_count() const;
  [[nodiscard]] const geometric::Configuration& configuration(int node) const;
  [[nodiscard]] double distance(int a, int b) const;

  /// The shortest way over edges that may be free, by A*; empty if there is none.
  [[nodiscard]] std::vector<int> shortest_path(int from, int to) const;

  /// @pre there is an edge between a and b.
  [[nodiscard]] bool is_certain(int a, int b) const;
  void confirm_edge(int a, int b);
  void remove_edge(int a, int b);

 private:
  struct Graph;
  std::unique_ptr<Graph> graph_;
};

}  // namespace handway::planning
