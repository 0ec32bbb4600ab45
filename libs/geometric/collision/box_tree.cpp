#include "collision/box_tree.h"

#include <tbb/parallel_invoke.h>

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
  nodes_.resize(2 * triangles.size() - 1);
  build(triangles, 0);
}

// A tree over n triangles takes 2 n - 1 nodes, so that both halves know their places.
void BoxTree::build(std::span<Triangle> triangles, std::size_t index) {
  constexpr std::size_t kWorthAThread = 10000;
  Node& node = nodes_[index];
  Eigen::Vector3d lower = triangles.front().lower;
  Eigen::Vector3d upper = triangles.front().upper;
  for (const Triangle& triangle : triangles) {
    lower = lower.cwiseMin(triangle.lower);
    upper = upper.cwiseMax(triangle.upper);
  }
  node.centre = 0.5 * (lower + upper);
  node.half = 0.5 * (upper - lower);
  node.size = node.half.norm();
  if (triangles.size() == 1) {
    node.triangle = triangles.front().index;
    return;
  }
  Eigen::Index axis = 0;
  (upper - lower).maxCoeff(&axis);
  const std::size_t half = triangles.size() / 2;
  std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half),
                   triangles.end(), [axis](const Triangle& s, const Triangle& t) {
                     return (s.lower + s.upper)[axis] < (t.lower + t.upper)[axis];
                   });
  const std::size_t right = index + 2 * half;
  node.right = static_cast<std::uint32_t>(right);
  const auto build_left = [&] { build(triangles.first(half), index + 1); };
  const auto build_right = [&] { build(triangles.subspan(half), right); };
  if (triangles.size() > kWorthAThread) {
    tbb::parallel_invoke(build_left, build_right);
  } else {
    build_left();
    build_right();
  }
}

}  // namespace handway::geometric
