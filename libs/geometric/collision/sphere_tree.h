#pragma once

#include "handway/geometric/scene/triangle_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace handway::geometric {

/// A binary tree of spheres, in the mesh's frame. The spheres of every level
/// together contain the whole surface; a child's triangles are its parent's.
class SphereTree {
 public:
  struct Node {
    Eigen::Vector3d centre;
    double radius = 0.0;
    std::uint32_t right = 0;  ///< The left child follows its parent; 0: a leaf.
  };

  /// @param leaf_radius (m) spheres are split until they are this small; large
  /// triangles are cut for that.
  /// @pre the mesh has a triangle.
  SphereTree(const TriangleMesh& mesh, double leaf_radius);

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const Node& root() const { return nodes_.front(); }

 private:
  struct Piece {
    Eigen::Vector3d a, b, c;
  };

  static void cut(const Piece& piece, double longest_edge, std::vector<Piece>& pieces);
  void build(std::vector<Piece>& pieces, std::size_t first, std::size_t count, double leaf_radius);

  std::vector<Node> nodes_;
};

}  // namespace handway::geometric
