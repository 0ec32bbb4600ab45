#include "collision/box_tree.h"

#include <algorithm>

namespace handway::geometric {

BoxTree::BoxTree(const TriangleMesh& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto& p = mesh.vertices[a];
    const auto& q = mesh.vertices[b];
    const auto& r = mesh.vertices[c];
    triangles.push_back({p.cwiseMin(q).cwiseMin(r), p.cwiseMax(q).cwiseMax(r),
                         static_cast<std::uint32_t>(triangles.size())});
  }
  nodes_.reserve(2 * triangles.size());
  build(triangles, 0, triangles.size());
}

void BoxTree::build(std::vector<Triangle>& triangles, std::size_t first, std::size_t count) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  Eigen::Vector3d lower = triangles[first].lower;
  Eigen::Vector3d upper = triangles[first].upper;
  for (std::size_t i = first; i < first + count; ++i) {
    lower = lower.cwiseMin(triangles[i].lower);
    upper = upper.cwiseMax(triangles[i].upper);
  }
  nodes_[index].centre = 0.5 * (lower + upper);
  nodes_[index].half = 0.5 * (upper - lower);
  nodes_[index].size = nodes_[index].half.norm();
  if (count == 1) {
    nodes_[index].triangle = triangles[first].index;
    return;
  }
  Eigen::Index axis = 0;
  (upper - lower).maxCoeff(&axis);
  const auto begin = triangles.begin() + static_cast<std::ptrdiff_t>(first);
  const auto half = static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(begin, begin + half, begin + static_cast<std::ptrdiff_t>(count),
                   [axis](const Triangle& s, const Triangle& t) {
                     return (s.lower + s.upper)[axis] < (t.lower + t.upper)[axis];
                   });
  build(triangles, first, static_cast<std::size_t>(half));
  nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
  build(triangles, first + static_cast<std::size_t>(half), count - static_cast<std::size_t>(half));
}

}  // namespace handway::geometric
