#include "io/mesh_cleaning.h"

#include "scene/vertex_table.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace handway::geometric {
namespace {

bool has_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  // The height over the longer side, relative to it, must exceed rounding.
  return ab.cross(ac).norm() > 1e-12 * std::max(ab.squaredNorm(), ac.squaredNorm());
}

}  // namespace

TriangleMesh cleaned(const TriangleMesh& mesh) {
  VertexTable places;
  TriangleMesh result;
  result.triangles.reserve(mesh.triangles.size());
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[i];
    const Eigen::Vector3d& b = mesh.vertices[j];
    const Eigen::Vector3d& c = mesh.vertices[k];
    if (has_area(a, b, c)) {
      const std::uint32_t first = places.number_of(a);
      const std::uint32_t second = places.number_of(b);
      result.triangles.push_back({first, second, places.number_of(c)});
    }
  }
  result.vertices = std::move(places.vertices());
  return result;
}

}  // namespace handway::geometric
