#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace handway::planning {

/// A node and how far it is from another.
using NodeDistance = std::pair<double, int>;

/// The `k` nearest of these nodes, or all if there are fewer, nearest first, of
/// equally far ones the lower number first.
[[nodiscard]] inline std::vector<NodeDistance> nearest_nodes(std::vector<NodeDistance> nodes,
                                                             int k) {
  const auto count = std::min(static_cast<std::size_t>(k), nodes.size());
  std::partial_sort(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(count), nodes.end());
  nodes.resize(count);
  return nodes;
}

}  // namespace handway::planning
