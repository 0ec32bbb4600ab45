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

  /// @param margin (m) above a hundredth of the size leaves out more vertices. It becomes larger if
  /// the hull would need many hundreds of them.
  /// @pre the mesh has a triangle.
  ConvexCover(const TriangleMesh& mesh, double margin);

  /// The hull's point that is farthest along `direction`.
  [[nodiscard]] Eigen::Vector3f support(const Eigen::Vector3f& direction) const;

  /// A point within the hull, m.
  [[nodiscard]] const Eigen::Vector3f& middle() const { return middle_; }
  /// The point of the box around the hull that is nearest to `p`, m.
  [[nodiscard]] Eigen::Vector3f nearest_in_box(const Eigen::Vector3f& p) const {
    return p.cwiseMax(lower_).cwiseMin(upper_);
  }
  [[nodiscard]] float margin() const { return margin_; }
  [[nodiscard]] std::size_t point_count() const { return count_; }
  /// The hull's corners, and possibly inner points, m.
  [[nodiscard]] std::vector<Eigen::Vector3d> points() const;

 private:
  friend class VolumeArchive;

  Eigen::Vector3f middle_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f lower_ = Eigen::Vector3f::Zero();  ///< Corners of the box around the points.
  Eigen::Vector3f upper_ = Eigen::Vector3f::Zero();
  float margin_ = 0.0F;
  std::size_t count_ = 0;
  std::vector<float> x_, y_, z_;  ///< Padded with the last one to full vectors.
};

/// A lower bound of the distance of two hulls.
struct HullGap {
  float distance = 0.0F;  ///< m; 0: no separating plane was found.
  Eigen::Vector3f p_BA =
      Eigen::Vector3f::Zero();  ///< A's point next to the plane, in B's frame. @pre distance > 0.
};

/// A lower bound of the distance of the contents of two hulls, from a few candidates for a
/// separating plane. The search ends once the bound is `enough` (m).
/// @param X_BA pose of A's frame in B's.
///
/// Source: Gilbert, Johnson and Keerthi, "A fast procedure for computing the distance between
/// complex objects in three-dimensional space", 1988: each step towards the nearest points gives a
/// plane between the hulls.
[[nodiscard]] HullGap hull_gap(const ConvexCover& a, const ConvexCover& b, const FloatPose& X_BA,
                               float enough);

/// A hull in motion about the middle of a stretch of an edge: a share s of the edge further on, its
/// point p has moved by s (v + w × p), and by at most ½ s² `bend` beside that. All in the world.
struct MovingHull {
  const ConvexCover& hull;
  const Pose& X_WHull;  ///< In the middle.
  Eigen::Vector3d v;    ///< m per edge, of the point at the origin.
  Eigen::Vector3d w;    ///< rad per edge.
  double bend;          ///< m per edge².
};

/// hull_gap() of hulls that move along a stretch of an edge: the distance that planes keep between
/// them from the middle of the stretch, where they are in place, to both of its ends.
/// @param half half of the stretch, as a share of the edge.
[[nodiscard]] double hull_gap_along(const MovingHull& a, const MovingHull& b, double half,
                                    double enough);

}  // namespace handway::geometric
