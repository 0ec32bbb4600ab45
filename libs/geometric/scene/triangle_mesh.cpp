#include "handway/geometric/scene/triangle_mesh.h"

#include <utility>

namespace handway::geometric {

Aabb bounding_box(const TriangleMesh& mesh) {
  Aabb box{mesh.vertices.front(), mesh.vertices.front()};
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    box.lower = box.lower.cwiseMin(vertex);
    box.upper = box.upper.cwiseMax(vertex);
  }
  return box;
}

TriangleMesh transformed(const TriangleMesh& mesh, const Pose& X_AB, const Eigen::Vector3d& scale) {
  TriangleMesh result = mesh;
  for (Eigen::Vector3d& vertex : result.vertices) {
    vertex = X_AB * scale.cwiseProduct(vertex);
  }
  if (scale.prod() < 0.0) {  // a mirrored mesh keeps its outward winding
    for (auto& triangle : result.triangles) {
      std::swap(triangle[1], triangle[2]);
    }
  }
  return result;
}

void append(TriangleMesh& whole, const TriangleMesh& part) {
  const auto offset = static_cast<std::uint32_t>(whole.vertices.size());
  whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& triangle : part.triangles) {
    whole.triangles.push_back({triangle[0] + offset, triangle[1] + offset, triangle[2] + offset});
  }
}

}  // namespace handway::geometric
