#pragma once

#include "collision/volumes/box_tree.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace handway::geometric {

using TriangleCorners = std::array<Eigen::Vector3d, 3>;

/// Below this (m) surfaces count as touching unless FCL decides otherwise: a small distance, so
/// that rounding can't hide a contact.
inline constexpr double kTouch = 1e-9;

/// The plane of a triangle, computed once for comparisons with many triangles.
class TrianglePlane {
 public:
  explicit TrianglePlane(const TriangleCorners& triangle);

  /// Returns whether all of the other triangle is more than `tolerance` (m) away, on one side;
  /// false if undecided.
  [[nodiscard]] bool is_beside(const TriangleCorners& other, double tolerance) const;

 private:
  Eigen::Vector3d corner_;
  Eigen::Vector3d normal_;  ///< Not of unit length.
  double length_;           ///< Length of the normal.
};

/// Returns whether an edge of one goes through the other, at least kTouch from its borders. Then
/// they collide in any arithmetic.
[[nodiscard]] bool surely_cross(const TriangleCorners& s, const TriangleCorners& t);

/// A few triangles in lanes, for the distance of a point from all at once.
class TriangleBlock {
 public:
  static constexpr std::size_t kWidth = 8;

  TriangleBlock() = default;

  /// @pre 1 to kWidth triangles.
  explicit TriangleBlock(std::span<const TriangleCorners> triangles);

  using Lanes = std::array<float, kWidth>;

  /// Squared distances (m²) of `p` from the triangles, up to single precision; unused lanes repeat
  /// the last one.
  [[nodiscard]] Lanes squared_distances(const Eigen::Vector3f& p) const;
  /// Distance (m) of `p` from the nearest triangle.
  [[nodiscard]] float distance(const Eigen::Vector3f& p) const;

 private:
  using Vectors = std::array<Lanes, 3>;

  alignas(32) std::array<Vectors, 3> corners_{};
  Vectors normals_{};  ///< Unit normals, or 0 for triangles without area.
};

/// The triangles of a mesh, eight to a leaf, below axis-aligned boxes, eight to a node: a search
/// for near triangles needs few memory accesses. It computes in single precision and counts
/// undecided triangles as near.
class TriangleTree {
 public:
  /// @pre the mesh has a triangle.
  explicit TriangleTree(const TriangleMesh& mesh);

  /// Returns whether a triangle is nearer to `p` (m, in the mesh's frame) than `distance` (m).
  [[nodiscard]] bool is_nearer_than(const Eigen::Vector3d& p, double distance) const;

  /// Returns whether a triangle is nearer than that whatever the rounding; false if undecided.
  [[nodiscard]] bool is_surely_nearer_than(const Eigen::Vector3d& p, double distance) const;

  /// Distance (m) of `p` from the nearest triangle, up to single precision; `within` (m) if none is
  /// nearer.
  [[nodiscard]] float distance(const Eigen::Vector3f& p, float within) const;

  /// Appends the triangles that are nearer to `p` than `distance` (m).
  void append_within(const Eigen::Vector3d& p, double distance,
                     std::vector<std::uint32_t>& triangles) const;

 private:
  friend class TriangleTreeBuilder;

  static constexpr std::size_t kWidth = 8;
  static constexpr std::uint32_t kLeaf = 0x80000000U;

  struct alignas(64) Node {
    std::array<std::array<float, kWidth>, 3> centre{};
    std::array<std::array<float, kWidth>, 3> half{};  ///< Unused: -1e30, never near.
    std::array<std::uint32_t, kWidth> child{};        ///< Node or, with kLeaf set, leaf.
  };
  struct Leaf {
    TriangleBlock block;
    std::array<std::uint32_t, TriangleBlock::kWidth> triangles{};  ///< Indices in the mesh.
    std::uint32_t count = 0;
  };

  /// Shows `visit` the leaves nearer to `p` than `distance`, which it may lower, until it has seen
  /// enough.
  template <typename Visit>
  void visit_near(const Eigen::Vector3f& p, const float& distance, const Visit& visit) const;
  /// `distance`, and what roundings may be off by.
  [[nodiscard]] float reach(const Eigen::Vector3d& p, double distance) const;
  /// Bound of the rounding of a distance (m) up to that one.
  [[nodiscard]] float rounding(const Eigen::Vector3d& p, double distance) const;
  [[nodiscard]] bool has_triangle_within(const Eigen::Vector3f& p, float distance) const;
  static std::uint32_t near_boxes(const Node& node, const Eigen::Vector3f& p, float distance,
                                  std::array<float, kWidth>& squared);

  float size_ = 0.0F;  ///< m: largest coordinate.
  std::uint32_t root_ = 0;
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
};

}  // namespace handway::geometric
