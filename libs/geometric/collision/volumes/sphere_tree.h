#pragma once

#include "collision/volumes/distance_field.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace handway::geometric {

/// A sphere, m.
struct BoundingSphere {
  Eigen::Vector3f centre;
  float radius = 0.0F;
};

class SphereTreeGrowth;

/// A tree of spheres in the mesh's frame, sixteen to a node so that they are tested together. The
/// spheres of every level together contain the whole surface; those of a node contain their
/// parent's part of it.
///
/// It is complete, or it grows on access: a node is made at its first visit, by any thread, and
/// depends on nothing but the mesh and the nodes above it. Copies grow together.
class SphereTree {
 public:
  static constexpr std::size_t kWidth = 16;

  struct alignas(64) Node {
    std::array<float, kWidth> x, y, z, radius;  ///< Unused entries: radius -1e30, never near.
    /// The surface in a sphere lies within `thickness` of a plane through its centre with this
    /// normal: for a flat surface it is a disk.
    std::array<float, kWidth> normal_x, normal_y, normal_z, thickness;
    /// Node below each sphere or, with kLeaf set, leaf.
    std::array<std::uint32_t, kWidth> child;
    std::uint32_t count = 0;
  };
  static constexpr std::uint32_t kLeaf = 0x80000000U;

  SphereTree() = default;

  /// A tree that grows. Its leaves are as small as requested, independent of the triangles' size.
  /// @pre the mesh has a triangle.
  [[nodiscard]] static SphereTree growing(std::shared_ptr<const TriangleMesh> mesh,
                                          double leaf_radius);

  static constexpr std::size_t kMostPieces = 1U << 16;

  /// A complete tree.
  /// @param leaf_radius (m) spheres are split until they are this small; large triangles are cut
  /// for that, but into at most kMostPieces more than their number: beyond that, spheres stay
  /// larger.
  /// @pre the mesh has a triangle.
  SphereTree(const TriangleMesh& mesh, double leaf_radius);

  [[nodiscard]] const BoundingSphere& root() const { return root_; }
  /// The node with that number, 0 being below the root.
  [[nodiscard]] const Node& node(std::uint32_t index) const {
    return growth_ ? grown_node(index) : nodes_[index];
  }
  /// Nodes of a complete tree.
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  /// Triangles whose pieces are in a leaf's sphere.
  [[nodiscard]] std::span<const std::uint32_t> triangles(std::uint32_t leaf) const {
    return growth_ ? grown_leaf(leaf)
                   : std::span<const std::uint32_t>{triangles_.data() + leaves_[leaf],
                                                    triangles_.data() + leaves_[leaf + 1]};
  }

 private:
  friend class VolumeArchive;

  [[nodiscard]] const Node& grown_node(std::uint32_t index) const;
  [[nodiscard]] std::span<const std::uint32_t> grown_leaf(std::uint32_t leaf) const;
  std::uint32_t copy_complete(SphereTreeGrowth& growth, std::uint32_t index);

  BoundingSphere root_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaves_;  ///< First of each leaf's triangles, and the end.
  std::vector<std::uint32_t> triangles_;
  std::shared_ptr<SphereTreeGrowth> growth_;  ///< Null: complete.
};

/// Rounding error of a moved point in single precision, per metre of its coordinates: some 30
/// roundings of 6e-8 each.
inline constexpr float kMoveRounding = 2e-6F;

/// A rigid transform in single precision, with the bound of its rounding error.
struct FloatPose {
  FloatPose() = default;
  /// @param reach (m) largest distance from A's origin of points to move.
  FloatPose(const Pose& X_BA, float reach);

  std::array<float, 9> R{};  ///< Row by row.
  std::array<float, 3> p{};
  float rounding = 0.0F;  ///< m: bound of a moved point's rounding error, or of a bound there.
};

/// Bounds of a node's spheres.
struct SphereBounds {
  std::uint32_t near = 0;  ///< Bit k: sphere k may be within the tolerance.
  alignas(64) std::array<float, SphereTree::kWidth> bound;  ///< m, of those; negative: overlap.
};

/// Returns the spheres of a node that may be nearer than `tolerance` (m) to the field's surface,
/// and sets lower bounds of their distances.
/// @param X_BA pose of the spheres' frame in the field's.
void sphere_bounds(const SphereTree::Node& node, const DistanceField& field, const FloatPose& X_BA,
                   float tolerance, SphereBounds& bounds);

}  // namespace handway::geometric
