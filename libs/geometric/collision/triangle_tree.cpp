#include "collision/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace handway::geometric {
namespace {

constexpr std::uint32_t kLeafSize = 2;
constexpr std::size_t kDeepest = 64;  // median splits: 2^64 triangles

// Closest point of a triangle by the region of the plane that the point
// projects to (Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
double squared_distance_to_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                    const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) {
    return ap.squaredNorm();
  }
  const Eigen::Vector3d bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) {
    return bp.squaredNorm();
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    return (ap - d1 / (d1 - d3) * ab).squaredNorm();
  }
  const Eigen::Vector3d cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) {
    return cp.squaredNorm();
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    return (ap - d2 / (d2 - d6) * ac).squaredNorm();
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && (d4 - d3) >= 0.0 && (d5 - d6) >= 0.0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return (bp - w * (c - b)).squaredNorm();
  }
  const double inverse = 1.0 / (va + vb + vc);
  return (ap - vb * inverse * ab - vc * inverse * ac).squaredNorm();
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
  triangles_.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles_.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  }
  nodes_.reserve(2 * triangles_.size());
  build(0, static_cast<std::uint32_t>(triangles_.size()));
}

void TriangleTree::build(std::uint32_t first, std::uint32_t count) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  Eigen::Vector3d lower = triangles_[first].a;
  Eigen::Vector3d upper = lower;
  for (std::uint32_t i = first; i < first + count; ++i) {
    const Triangle& t = triangles_[i];
    lower = lower.cwiseMin(t.a).cwiseMin(t.b).cwiseMin(t.c);
    upper = upper.cwiseMax(t.a).cwiseMax(t.b).cwiseMax(t.c);
  }
  nodes_[index].lower = lower;
  nodes_[index].upper = upper;
  if (count <= kLeafSize) {
    nodes_[index].first = first;
    nodes_[index].count = count;
    return;
  }
  Eigen::Index axis = 0;
  (upper - lower).maxCoeff(&axis);
  const auto begin = triangles_.begin() + first;
  const std::uint32_t half = count / 2;
  std::nth_element(begin, begin + half, begin + count,
                   [axis](const Triangle& s, const Triangle& t) {
                     return (s.a + s.b + s.c)[axis] < (t.a + t.b + t.c)[axis];
                   });
  build(first, half);
  nodes_[index].first = static_cast<std::uint32_t>(nodes_.size());
  build(first + half, count - half);
}

double TriangleTree::squared_distance(const Node& node, const Eigen::Vector3d& point) {
  return (node.lower - point).cwiseMax(point - node.upper).cwiseMax(0.0).squaredNorm();
}

double TriangleTree::distance_within(const Eigen::Vector3d& point, double cutoff) const {
  double best = cutoff * cutoff;
  if (squared_distance(nodes_[0], point) >= best) {
    return cutoff;
  }
  struct Waiting {
    std::uint32_t node;
    double squared;
  };
  std::array<Waiting, kDeepest> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {0, 0.0};
  while (waiting > 0) {
    const Waiting top = stack[--waiting];
    if (top.squared >= best) {
      continue;
    }
    const Node& node = nodes_[top.node];
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const Triangle& t = triangles_[i];
        best = std::min(best, squared_distance_to_triangle(point, t.a, t.b, t.c));
      }
      continue;
    }
    Waiting near{top.node + 1, squared_distance(nodes_[top.node + 1], point)};
    Waiting far{node.first, squared_distance(nodes_[node.first], point)};
    if (far.squared < near.squared) {
      std::swap(near, far);
    }
    if (far.squared < best) {
      stack[waiting++] = far;
    }
    if (near.squared < best) {
      stack[waiting++] = near;
    }
  }
  return std::sqrt(best);
}

}  // namespace handway::geometric
