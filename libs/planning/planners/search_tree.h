#pragma once

#include "handway/planning/core/planning_problem.h"

#include <Eigen/Core>

#include <vector>

namespace handway::planning {

/// A tree of configurations that grows from its root, node 0. Distances are
/// Euclidean in the coordinates of a SearchSpace.
class SearchTree {
 public:
  SearchTree(Configuration root, const Eigen::VectorXd& coordinates);

  int add(Configuration q, const Eigen::VectorXd& coordinates, int parent);
  [[nodiscard]] int nearest(const Eigen::VectorXd& coordinates) const;

  [[nodiscard]] int size() const { return static_cast<int>(configurations_.size()); }
  [[nodiscard]] const Configuration& configuration(int node) const {
    return configurations_[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] auto coordinates(int node) const { return coordinates_.col(node); }

  /// From the root to `node`.
  [[nodiscard]] std::vector<Configuration> branch(int node) const;

 private:
  std::vector<Configuration> configurations_;
  std::vector<int> parents_;
  Eigen::MatrixXd coordinates_;  ///< A column a node; grows by doubling.
};

}  // namespace handway::planning
