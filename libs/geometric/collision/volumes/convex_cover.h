#pragma once

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

}  // namespace handway::geometric
