#pragma once

#include "handway/geometric/scene/triangle_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace handway::geometric {

/// A sphere, m.
struct BoundingSphere {
  Eigen::Vector3f centre;
  float radius = 0.0F;
};

/// A tree of spheres in the mesh's frame, sixteen to a node so that they are
/// asked together. The spheres of every level together contain the whole
/// surface; those of a node contain what its parent's sphere is for.
class SphereCover {
 public:
  static constexpr std::size_t kWidth = 16;

  struct alignas(64) Node {
    std::array<float, kWidth> x, y, z, radius;  ///< Past `count`: radius -1e30, never near.
    /// The surface in a sphere lies within `thickness` of a plane through its
    /// centre with this normal: it is a disk where it is flat.
    std::array<float, kWidth> normal_x, normal_y, normal_z, thickness;
    /// Node below each sphere or, with kLeaf set, leaf.
    std::array<std::uint32_t, kWidth> child;
    std::uint32_t count = 0;
  };
  static constexpr std::uint32_t kLeaf = 0x80000000U;

  SphereCover() = default;

  static constexpr std::size_t kMostPieces = 1U << 16;

  /// @param leaf_radius (m) spheres are split until they are this small; large
  /// triangles are cut for that, but into no more than kMostPieces beyond their
  /// number: where that is too few, spheres stay larger.
  /// @pre the mesh has a triangle.
  SphereCover(const TriangleMesh& mesh, double leaf_radius);

  [[nodiscard]] const BoundingSphere& root() const { return root_; }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  /// Triangles whose pieces are in a leaf's sphere.
  [[nodiscard]] std::span<const std::uint32_t> triangles(std::uint32_t leaf) const {
    return {triangles_.data() + leaves_[leaf], triangles_.data() + leaves_[leaf + 1]};
  }

 private:
  friend class SphereCoverBuilder;
  friend class VolumeArchive;

  BoundingSphere root_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaves_;  ///< First of each leaf's triangles, and the end.
  std::vector<std::uint32_t> triangles_;
};

}  // namespace handway::geometric
