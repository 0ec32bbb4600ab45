#pragma once

#include "handway/geometric/scene/triangle_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace handway::geometric {

/// Axis-aligned boxes over the triangles of a mesh, in the mesh's frame, for
/// distances from points.
class TriangleTree {
 public:
  /// @pre the mesh has a triangle.
  explicit TriangleTree(const TriangleMesh& mesh);

  /// The distance (m) of `point` from the nearest triangle, or `cutoff` if all
  /// are at least that far.
  [[nodiscard]] double distance_within(const Eigen::Vector3d& point, double cutoff) const;

 private:
  struct Node {
    Eigen::Vector3d lower;
    Eigen::Vector3d upper;
    std::uint32_t first = 0;  ///< Leaf: first triangle. Inner: the right child; the left follows.
    std::uint32_t count = 0;  ///< Leaf: triangles. Inner: 0.
  };
  struct Triangle {
    Eigen::Vector3d a, b, c;
  };

  void build(std::uint32_t first, std::uint32_t count);
  static double squared_distance(const Node& node, const Eigen::Vector3d& point);

  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
};

}  // namespace handway::geometric
