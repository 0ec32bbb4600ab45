#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace handway::geometric {

/// A binary tree of axis-aligned boxes, in the mesh's frame. The boxes of every
/// level together contain the whole surface; a leaf holds one triangle.
class BoxTree {
 public:
  struct Node {
    Eigen::Vector3d centre;
    Eigen::Vector3d half;        ///< Half the edges.
    std::uint32_t right = 0;     ///< The left child follows its parent; 0: a leaf.
    std::uint32_t triangle = 0;  ///< Index in the mesh, in a leaf.
    double size = 0.0;           ///< Half the diagonal.
  };

  /// @pre the mesh has a triangle.
  explicit BoxTree(const TriangleMesh& mesh);

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }

  /// Distance (m) of `point` from the node's box; 0 inside.
  [[nodiscard]] static double distance(const Node& node, const Eigen::Vector3d& point) {
    return std::sqrt(squared_distance(node, point));
  }
  [[nodiscard]] static double squared_distance(const Node& node, const Eigen::Vector3d& point) {
    return ((point - node.centre).cwiseAbs() - node.half).cwiseMax(0.0).squaredNorm();
  }

 private:
  struct Triangle {
    Eigen::Vector3d lower;
    Eigen::Vector3d upper;
    std::uint32_t index;
  };

  void build(std::span<Triangle> triangles, std::size_t index);

  std::vector<Node> nodes_;
};

/// The point of a mesh's surface that is nearest to another point.
struct NearestPoint {
  Eigen::Vector3d point;
  double distance;  ///< m
  std::uint32_t triangle;
};

/// Corners of a triangle, in the mesh's frame.
[[nodiscard]] inline std::array<Eigen::Vector3d, 3> corners(const TriangleMesh& mesh,
                                                            std::uint32_t triangle) {
  const auto& [i, j, k] = mesh.triangles[triangle];
  return {mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]};
}

/// The point of the triangle that is nearest to `p`.
///
/// Source: Ericson, "Real-Time Collision Detection", 2005, section 5.1.5.
[[nodiscard]] Eigen::Vector3d nearest_on_triangle(const std::array<Eigen::Vector3d, 3>& triangle,
                                                  const Eigen::Vector3d& p);

/// @param hint first triangle: a nearer one makes the search faster.
[[nodiscard]] NearestPoint nearest_point(const TriangleMesh& mesh, const BoxTree& boxes,
                                         const Eigen::Vector3d& p, std::uint32_t hint = 0);

}  // namespace handway::geometric
