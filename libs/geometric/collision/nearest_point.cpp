#include "collision/nearest_point.h"

#include <array>
#include <cmath>
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

NearestPoint nearest_point(const TriangleMesh& mesh, const BoxTree& boxes, const Eigen::Vector3d& p,
                           std::uint32_t hint) {
  NearestPoint nearest{nearest_on_triangle(corners(mesh, hint), p), 0.0, hint};
  double least = (p - nearest.point).squaredNorm();
  struct Waiting {
    std::uint32_t node;
    double bound;  // squared
  };
  std::array<Waiting, 128> stack;  // trees halve their triangles: never as deep
  std::size_t waiting = 0;
  stack[waiting++] = {0, 0.0};
  while (waiting > 0) {
    const Waiting top = stack[--waiting];
    if (top.bound >= least) {
      continue;
    }
    const BoxTree::Node& node = boxes.nodes()[top.node];
    if (node.right == 0) {
      const Eigen::Vector3d point = nearest_on_triangle(corners(mesh, node.triangle), p);
      if (const double squared = (p - point).squaredNorm(); squared < least) {
        least = squared;
        nearest = {point, 0.0, node.triangle};
      }
      continue;
    }
    Waiting near{top.node + 1, BoxTree::squared_distance(boxes.nodes()[top.node + 1], p)};
    Waiting far{node.right, BoxTree::squared_distance(boxes.nodes()[node.right], p)};
    if (far.bound < near.bound) {
      std::swap(near, far);
    }
    if (far.bound < least) {
      stack[waiting++] = far;
    }
    if (near.bound < least) {
      stack[waiting++] = near;
    }
  }
  nearest.distance = std::sqrt(least);
  return nearest;
}

bool is_nearer_than(const TriangleMesh& mesh, const BoxTree& boxes, const Eigen::Vector3d& p,
                    double distance) {
  const double squared = distance * distance;
  std::array<std::uint32_t, 128> stack;  // trees halve their triangles: never as deep
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const std::uint32_t index = stack[--waiting];
    const BoxTree::Node& node = boxes.nodes()[index];
    if (node.right == 0) {
      const Eigen::Vector3d point = nearest_on_triangle(corners(mesh, node.triangle), p);
      if ((p - point).squaredNorm() < squared) {
        return true;
      }
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
    if (to_far < squared) {
      stack[waiting++] = far;
    }
    if (to_near < squared) {
      stack[waiting++] = near;
    }
  }
  return false;
}

void triangles_within(const TriangleMesh& mesh, const BoxTree& boxes, const Eigen::Vector3d& p,
                      double distance, std::vector<std::uint32_t>& triangles) {
  const double squared = distance * distance;
  std::array<std::uint32_t, 128> stack;  // trees halve their triangles: never as deep
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const std::uint32_t index = stack[--waiting];
    const BoxTree::Node& node = boxes.nodes()[index];
    if (BoxTree::squared_distance(node, p) >= squared) {
      continue;
    }
    if (node.right != 0) {
      stack[waiting++] = node.right;
      stack[waiting++] = index + 1;
    } else if ((p - nearest_on_triangle(corners(mesh, node.triangle), p)).squaredNorm() < squared) {
      triangles.push_back(node.triangle);
    }
  }
}

}  // namespace handway::geometric
