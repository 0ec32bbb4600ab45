#pragma once

#include "collision/volumes/sphere_tree.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace handway::geometric {

/// A few of a mesh's vertices, in its frame: their convex hull, grown by a margin,
/// contains the mesh.
class ConvexCover {
 public:
  ConvexCover() = default;

  /// @param margin (m) above a hundredth of the size leaves out more vertices.
  /// @pre the mesh has a triangle.
  ConvexCover(const TriangleMesh& mesh, double margin);

  /// The hull's point that is farthest along `direction`.
  [[nodiscard]] Eigen::Vector3f support(const Eigen::Vector3f& direction) const;

  /// A point within the hull, m.
  [[nodiscard]] const Eigen::Vector3f& middle() const { return middle_; }
  [[nodiscard]] float margin() const { return margin_; }
  [[nodiscard]] std::size_t point_count() const { return count_; }
  /// The hull's corners, and possibly inner points, m.
  [[nodiscard]] std::vector<Eigen::Vector3d> points() const;

 private:
  friend class VolumeArchive;

  Eigen::Vector3f middle_ = Eigen::Vector3f::Zero();
  float margin_ = 0.0F;
  std::size_t count_ = 0;
  std::vector<float> x_, y_, z_;  ///< Padded with the last one to full vectors.
};

/// A lower bound (m) of the distance of the contents of two hulls, from a few candidates for a
/// separating plane; 0 if none separates them. The search ends once the bound is `enough`.
/// @param X_BA pose of A's frame in B's.
///
/// Source: Gilbert's algorithm for the nearest points of two convex sets (Gilbert,
/// "An iterative procedure for computing the minimum of a quadratic form on a
/// convex set", 1966): each of its steps gives a plane between them.
[[nodiscard]] float hull_gap(const ConvexCover& a, const ConvexCover& b, const FloatPose& X_BA,
                             float enough);

}  // namespace handway::geometric
