#include "collision/volumes/box_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

// A tree over n triangles takes 2 n - 1 nodes, so that both halves know their positions.
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

namespace {

Eigen::Vector3d nearest_on_edge(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                const Eigen::Vector3d& p) {
  const double squared = (b - a).squaredNorm();
  const double along = (p - a).dot(b - a);
  return squared > 0.0 ? Eigen::Vector3d(a + std::clamp(along / squared, 0.0, 1.0) * (b - a)) : a;
}

// Returns the nearest point on a degenerate triangle's edges.
Eigen::Vector3d nearest_on_edges(const std::array<Eigen::Vector3d, 3>& triangle,
                                 const Eigen::Vector3d& p) {
  Eigen::Vector3d nearest = triangle[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d point = nearest_on_edge(triangle[k], triangle[(k + 1) % 3], p);
    if ((p - point).squaredNorm() < (p - nearest).squaredNorm()) {
      nearest = point;
    }
  }
  return nearest;
}

}  // namespace

Eigen::Vector3d nearest_on_triangle(const std::array<Eigen::Vector3d, 3>& triangle,
                                    const Eigen::Vector3d& p) {
  constexpr double kNeedle = 1e-13;  // of the terms: what rounding leaves of them
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0.0 && d2 <= 0.0) {
    return a;
  }
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0.0 && d4 <= d3) {
    return b;
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3) {
    return a + d1 / (d1 - d3) * ab;
  }
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0.0 && d5 <= d6) {
    return c;
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    return a + d2 / (d2 - d6) * ac;
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  }
  const double sum = va + vb + vc;
  if (sum <= kNeedle * (std::abs(d1 * d4) + std::abs(d2 * d5) + std::abs(d3 * d6))) {
    return nearest_on_edges(triangle, p);
  }
  return a + vb / sum * ab + vc / sum * ac;
}

namespace {

double squared_distance(const TriangleMesh& mesh, std::uint32_t triangle,
                        const Eigen::Vector3d& p) {
  return (p - nearest_on_triangle(corners(mesh, triangle), p)).squaredNorm();
}

}  // namespace

NearestPoint nearest_point(const TriangleMesh& mesh, const BoxTree& boxes, const Eigen::Vector3d& p,
                           std::uint32_t hint) {
  std::array<std::uint32_t, 128> stack;  // trees halve their triangles: never as deep
  std::array<double, 128> bounds;        // squared
  std::size_t waiting = 0;
  stack[waiting] = 0;
  bounds[waiting++] = 0.0;
  std::uint32_t nearest = hint;
  double least = squared_distance(mesh, hint, p);
  while (waiting > 0) {
    --waiting;
    if (bounds[waiting] >= least) {
      continue;
    }
    const std::uint32_t index = stack[waiting];
    const BoxTree::Node& node = boxes.nodes()[index];
    if (node.right == 0) {
      const double squared = squared_distance(mesh, node.triangle, p);
      nearest = squared < least ? node.triangle : nearest;
      least = std::min(squared, least);
      continue;
    }
    std::uint32_t near = index + 1;
    std::uint32_t far = node.right;
    double to_near = BoxTree::squared_distance(boxes.nodes()[near], p);
    double to_far = BoxTree::squared_distance(boxes.nodes()[far], p);
    if (to_far < to_near) {
      std::swap(near, far);
      std::swap(to_near, to_far);
    }
    stack[waiting] = far;
    bounds[waiting++] = to_far;
    stack[waiting] = near;
    bounds[waiting++] = to_near;
  }
  const Eigen::Vector3d point = nearest_on_triangle(corners(mesh, nearest), p);
  return {point, (p - point).norm(), nearest};
}

}  // namespace handway::geometric
