#include "collision/triangle_block.h"

#include "collision/vector_units.h"

#include <algorithm>
#include <cmath>

namespace handway::geometric {

TriangleBlock::TriangleBlock(std::span<const TriangleCorners> triangles) {
  for (std::size_t k = 0; k < kWidth; ++k) {
    const TriangleCorners& t = triangles[std::min(k, triangles.size() - 1)];
    const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    const double length = normal.norm();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        corners_[corner][axis][k] = static_cast<float>(t[corner][i]);
      }
      normals_[axis][k] = length > 0.0 ? static_cast<float>(normal[i] / length) : 0.0F;
    }
  }
}

// Over a triangle's face the distance from its plane counts, elsewhere that from
// its edges.
HANDWAY_VECTOR_UNITS TriangleBlock::Lanes TriangleBlock::squared_distances(
    const Eigen::Vector3f& p) const {
  Lanes squared;
  const float px = p.x();
  const float py = p.y();
  const float pz = p.z();
  for (std::size_t k = 0; k < kWidth; ++k) {
    const float nx = normals_[0][k];
    const float ny = normals_[1][k];
    const float nz = normals_[2][k];
    float from_edges = 1e30F;
    float least_side = 1e30F;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vectors& a = corners_[corner];
      const Vectors& b = corners_[(corner + 1) % 3];
      const float ex = b[0][k] - a[0][k];
      const float ey = b[1][k] - a[1][k];
      const float ez = b[2][k] - a[2][k];
      const float qx = px - a[0][k];
      const float qy = py - a[1][k];
      const float qz = pz - a[2][k];
      const float along =
          (ex * qx + ey * qy + ez * qz) / std::max(ex * ex + ey * ey + ez * ez, 1e-30F);
      const float t = std::min(std::max(along, 0.0F), 1.0F);
      const float dx = qx - t * ex;
      const float dy = qy - t * ey;
      const float dz = qz - t * ez;
      from_edges = std::min(from_edges, dx * dx + dy * dy + dz * dz);
      const float side =
          (ny * ez - nz * ey) * qx + (nz * ex - nx * ez) * qy + (nx * ey - ny * ex) * qz;
      least_side = std::min(least_side, side);
    }
    const float above = nx * (px - corners_[0][0][k]) + ny * (py - corners_[0][1][k]) +
                        nz * (pz - corners_[0][2][k]);
    const bool over_face = least_side > 0.0F;
    squared[k] = over_face ? above * above : from_edges;
  }
  return squared;
}

float TriangleBlock::distance(const Eigen::Vector3f& p) const {
  return std::sqrt(std::ranges::min(squared_distances(p)));
}

}  // namespace handway::geometric
