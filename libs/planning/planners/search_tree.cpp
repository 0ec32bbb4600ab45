#include "planners/search_tree.h"

#include <algorithm>
#include <utility>

namespace handway::planning {

SearchTree::SearchTree(Configuration root, const Eigen::VectorXd& coordinates)
    : coordinates_(coordinates.size(), 64) {
  add(std::move(root), coordinates, -1);
}

int SearchTree::add(Configuration q, const Eigen::VectorXd& coordinates, int parent) {
  const int node = size();
  if (node == coordinates_.cols()) {
    coordinates_.conservativeResize(Eigen::NoChange, 2 * coordinates_.cols());
  }
  configurations_.push_back(std::move(q));
  parents_.push_back(parent);
  coordinates_.col(node) = coordinates;
  return node;
}

int SearchTree::nearest(const Eigen::VectorXd& coordinates) const {
  Eigen::Index node = 0;
  (coordinates_.leftCols(size()).colwise() - coordinates).colwise().squaredNorm().minCoeff(&node);
  return static_cast<int>(node);
}

std::vector<Configuration> SearchTree::branch(int node) const {
  std::vector<Configuration> waypoints;
  for (int at = node; at >= 0; at = parents_[static_cast<std::size_t>(at)]) {
    waypoints.push_back(configuration(at));
  }
  std::ranges::reverse(waypoints);
  return waypoints;
}

}  // namespace handway::planning
