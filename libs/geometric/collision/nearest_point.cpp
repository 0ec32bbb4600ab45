#include "collision/nearest_point.h"

#include <algorithm>
#include <array>
#include <utility>

namespace handway::geometric {

Eigen::Vector3d nearest_on_triangle(const std::array<Eigen::Vector3d, 3>& triangle,
                                    const Eigen::Vector3d& p) {
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
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
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
  return a + vb / sum * ab + vc / sum * ac;
}

namespace {

// Shows `visit` the triangles whose boxes are nearer to `p` than the root of `squared`,
// and goes on with what it says `squared` is then; of two boxes the nearer goes first.
template <typename Visit>
void visit_near(const BoxTree& boxes, const Eigen::Vector3d& p, double squared,
                const Visit& visit) {
  std::array<std::uint32_t, 128> stack;  // trees halve their triangles: never as deep
  std::array<double, 128> bounds;        // squared
  std::size_t waiting = 0;
  std::uint32_t index = 0;
  while (true) {
    const BoxTree::Node& node = boxes.nodes()[index];
    if (node.right == 0) {
      squared = visit(node.triangle, squared);
    } else {
      std::uint32_t near = index + 1;
      std::uint32_t far = node.right;
      double to_near = BoxTree::squared_distance(boxes.nodes()[near], p);
      double to_far = BoxTree::squared_distance(boxes.nodes()[far], p);
      if (to_far < to_near) {
        std::swap(near, far);
        std::swap(to_near, to_far);
      }
      if (to_far < squared) {
        stack[waiting] = far;
        bounds[waiting++] = to_far;
      }
      if (to_near < squared) {
        index = near;
        continue;
      }
    }
    do {
      if (waiting == 0) {
        return;
      }
      --waiting;
    } while (bounds[waiting] >= squared);
    index = stack[waiting];
  }
}

double squared_distance(const TriangleMesh& mesh, std::uint32_t triangle,
                        const Eigen::Vector3d& p) {
  return (p - nearest_on_triangle(corners(mesh, triangle), p)).squaredNorm();
}

}  // namespace

NearestPoint nearest_point(const TriangleMesh& mesh, const BoxTree& boxes, const Eigen::Vector3d& p,
                           std::uint32_t hint) {
  std::uint32_t nearest = hint;
  const auto visit = [&](std::uint32_t triangle, double least) {
    const double squared = squared_distance(mesh, triangle, p);
    nearest = squared < least ? triangle : nearest;
    return std::min(squared, least);
  };
  visit_near(boxes, p, squared_distance(mesh, hint, p), visit);
  const Eigen::Vector3d point = nearest_on_triangle(corners(mesh, nearest), p);
  return {point, (p - point).norm(), nearest};
}

bool is_nearer_than(const TriangleMesh& mesh, const BoxTree& boxes, const Eigen::Vector3d& p,
                    double distance) {
  bool found = false;
  visit_near(boxes, p, distance * distance, [&](std::uint32_t triangle, double squared) {
    found = found || squared_distance(mesh, triangle, p) < squared;
    return found ? 0.0 : squared;  // nothing else is of interest then
  });
  return found;
}

void triangles_within(const TriangleMesh& mesh, const BoxTree& boxes, const Eigen::Vector3d& p,
                      double distance, std::vector<std::uint32_t>& triangles) {
  visit_near(boxes, p, distance * distance, [&](std::uint32_t triangle, double squared) {
    if (squared_distance(mesh, triangle, p) < squared) {
      triangles.push_back(triangle);
    }
    return squared;
  });
}

}  // namespace handway::geometric
