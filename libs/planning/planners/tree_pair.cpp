#include "planners/tree_pair.h"

#include <limits>
#include <utility>

namespace handway::planning {
namespace {

constexpr int kNoParent = -1;

}  // namespace

TreePair::TreePair(const Configuration& start, const Eigen::VectorXd& start_coordinates,
                   const Configuration& goal, const Eigen::VectorXd& goal_coordinates,
                   const geometric::Periods& periods)
    : neighbours_{Neighbours(Neighbours::kLinear, periods),
                  Neighbours(Neighbours::kLinear, periods)} {
  append({start, start_coordinates, 0, kNoParent, true});
  append({goal, goal_coordinates, 1, kNoParent, true});
}

int TreePair::add(Configuration q, const Eigen::VectorXd& coordinates, int parent, bool certain) {
  return append({std::move(q), coordinates, at(parent).tree, parent, certain});
}

int TreePair::append(Node node) {
  const int number = size();
  const auto tree = static_cast<std::size_t>(node.tree);
  members_.at(tree).push_back(number);
  neighbours_.at(tree).add(number, node.coordinates);
  nodes_.push_back(std::move(node));
  return number;
}

int TreePair::nearest(int tree, const Eigen::VectorXd& coordinates) const {
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  const auto is_member = [&](int node) { return tree_of(node) == tree; };
  return neighbours_.at(static_cast<std::size_t>(tree))
      .nearest(coordinates, 1, kAnywhere, is_member)
      .front()
      .second;
}

// Returns the nodes from `node` to its root.
std::vector<int> TreePair::branch(int node) const {
  std::vector<int> nodes;
  for (int up = node; up != kNoParent; up = at(up).parent) {
    nodes.push_back(up);
  }
  return nodes;
}

TreePair::Connection TreePair::connection(int start_side, int goal_side) const {
  const std::vector<int> before = branch(start_side);
  const std::vector<int> after = branch(goal_side);
  Connection connection;
  connection.nodes.assign(before.rbegin(), before.rend());
  connection.bridge = connection.nodes.size() - 1;
  connection.nodes.insert(connection.nodes.end(), after.begin(), after.end());
  for (std::size_t i = 0; i + 1 < connection.nodes.size(); ++i) {
    connection.certain.push_back(i < connection.bridge   ? at(connection.nodes[i + 1]).certain
                                 : i > connection.bridge ? at(connection.nodes[i]).certain
                                                         : false);
  }
  return connection;
}

void TreePair::confirm(const Connection& connection, std::size_t edge) {
  if (edge != connection.bridge) {
    at(connection.nodes[edge < connection.bridge ? edge + 1 : edge]).certain = true;
  }
}

void TreePair::cut(const Connection& connection, std::size_t edge, bool bridge_certain) {
  if (edge == connection.bridge) {
    return;
  }
  // Along the connection from the cut to the bridge, parents and children are swapped.
  const bool in_start_tree = edge < connection.bridge;
  int parent = connection.nodes[in_start_tree ? connection.bridge + 1 : connection.bridge];
  bool certain = bridge_certain;
  for (std::size_t i = connection.bridge; i != edge; in_start_tree ? --i : ++i) {
    const int node = connection.nodes[in_start_tree ? i : i + 1];
    const bool next_certain = at(node).certain;
    at(node).parent = parent;
    at(node).certain = certain;
    parent = node;
    certain = next_certain;
  }
  assign_trees();
}

// Assigns each node to the tree of its root.
void TreePair::assign_trees() {
  std::vector<bool> known(nodes_.size(), false);
  known[0] = true;
  known[1] = true;
  for (int node = 0; node < size(); ++node) {
    std::vector<int> unknown;
    int up = node;
    while (!known[static_cast<std::size_t>(up)]) {
      unknown.push_back(up);
      up = at(up).parent;
    }
    for (const int below : unknown) {
      Node& moved = at(below);
      if (moved.tree != at(up).tree && !moved.was_in_both) {
        moved.was_in_both = true;
        neighbours_.at(static_cast<std::size_t>(at(up).tree)).add(below, moved.coordinates);
      }
      moved.tree = at(up).tree;
      known[static_cast<std::size_t>(below)] = true;
    }
  }
  for (std::vector<int>& nodes : members_) {
    nodes.clear();
  }
  for (int node = 0; node < size(); ++node) {
    members_.at(static_cast<std::size_t>(tree_of(node))).push_back(node);
  }
}

}  // namespace handway::planning
