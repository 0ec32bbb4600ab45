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

  /// Distance (m) of `p` from the nearest triangle, up to single precision.
  [[nodiscard]] float distance(const Eigen::Vector3f& p) const;

 private:
  using Lanes = std::array<float, kWidth>;
  using Vectors = std::array<Lanes, 3>;

  alignas(32) std::array<Vectors, 3> corners_{};
  Vectors normals_{};  ///< Of length 1, or 0 where a triangle has no area.
};

}  // namespace handway::geometric
