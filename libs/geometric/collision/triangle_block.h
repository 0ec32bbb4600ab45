#pragma once

#include "collision/triangle_contact.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>

namespace handway::geometric {

/// A few triangles side by side, for the distance of a point from all at once.
class TriangleBlock {
 public:
  static constexpr std::size_t kWidth = 8;

  TriangleBlock() = default;

  /// @pre 1 to kWidth triangles.
  explicit TriangleBlock(std::span<const TriangleCorners> triangles);

  using Lanes = std::array<float, kWidth>;

  /// Squared distances (m²) of `p` from the triangles, up to single precision; past the
  /// last one, that from it again.
  [[nodiscard]] Lanes squared_distances(const Eigen::Vector3f& p) const;
  /// Distance (m) of `p` from the nearest triangle.
  [[nodiscard]] float distance(const Eigen::Vector3f& p) const;

 private:
  using Vectors = std::array<Lanes, 3>;

  alignas(32) std::array<Vectors, 3> corners_{};
  Vectors normals_{};  ///< Of length 1, or 0 where a triangle has no area.
};

}  // namespace handway::geometric
