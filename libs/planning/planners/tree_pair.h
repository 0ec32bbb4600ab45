#pragma once

#include "handway/planning/core/planning_problem.h"
#include "roadmap/neighbours.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace handway::planning {

/// Two trees of configurations, of the start (tree 0, rooted at node 0) and of
/// the goal (tree 1, rooted at node 1), over one set of nodes. Distances are
/// those of a StateSpace.
///
/// Edges may be uncertain. When one of a connection through both trees turns out not to be free,
/// the subtree behind it moves to the other tree, and no node is lost.
///
/// Source: Sánchez, Latombe, "A single-query bi-directional probabilistic roadmap
/// planner with lazy collision checking", ISRR 2001, section 3.4.
class TreePair {
 public:
  TreePair(const Configuration& start, const Eigen::VectorXd& start_coordinates,
           const Configuration& goal, const Eigen::VectorXd& goal_coordinates,
           const geometric::Periods& periods = {});

  /// Adds a node below `parent`, in the parent's tree. @param certain the edge is known to be
  /// free.
  int add(Configuration q, const Eigen::VectorXd& coordinates, int parent, bool certain);

  [[nodiscard]] int nearest(int tree, const Eigen::VectorXd& coordinates) const;
  [[nodiscard]] int size() const { return static_cast<int>(nodes_.size()); }
  [[nodiscard]] int tree_of(int node) const { return at(node).tree; }
  /// Nodes in the order of their addition.
  [[nodiscard]] const std::vector<int>& nodes(int tree) const {
    return members_.at(static_cast<std::size_t>(tree));
  }
  /// The parent of a node; a root's is itself.
  [[nodiscard]] int parent(int node) const { return at(node).parent < 0 ? node : at(node).parent; }
  [[nodiscard]] const Configuration& configuration(int node) const { return at(node).q; }
  [[nodiscard]] const Eigen::VectorXd& coordinates(int node) const { return at(node).coordinates; }

  /// A connection from start to goal by an edge between a node of tree 0 and one of tree 1.
  struct Connection {
    std::vector<int> nodes;     ///< From start to goal.
    std::vector<bool> certain;  ///< Per edge: edge i is from nodes[i] to nodes[i + 1].
    std::size_t bridge = 0;     ///< The edge between the trees.
  };
  /// @pre `start_side` is in tree 0, `goal_side` in tree 1.
  [[nodiscard]] Connection connection(int start_side, int goal_side) const;

  /// Records that edge `edge` of `connection` is free, unless it is the bridge.
  void confirm(const Connection& connection, std::size_t edge);

  /// Removes edge `edge` of `connection`, which is not free. Unless it is the bridge, the nodes
  /// between it and the bridge, with their subtrees, move to the other tree.
  /// @param bridge_certain the bridge is known to be free.
  void cut(const Connection& connection, std::size_t edge, bool bridge_certain);

 private:
  struct Node {
    Configuration q;
    Eigen::VectorXd coordinates;
    int tree;
    int parent;                ///< -1: a root.
    bool certain;              ///< The edge to the parent.
    bool was_in_both = false;  ///< It was moved to the other tree once.
  };

  [[nodiscard]] const Node& at(int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] Node& at(int node) { return nodes_[static_cast<std::size_t>(node)]; }
  int append(Node node);
  [[nodiscard]] std::vector<int> branch(int node) const;
  void assign_trees();

  std::vector<Node> nodes_;
  std::array<std::vector<int>, 2> members_;  ///< Nodes of each tree.
  std::array<Neighbours, 2> neighbours_;     ///< Nodes that were ever in each tree.
};

}  // namespace handway::planning
