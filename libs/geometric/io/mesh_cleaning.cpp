#include "io/mesh_cleaning.h"

#include <bit>
#include <unordered_map>

namespace handway::geometric {
namespace {

struct SamePoint {
  bool operator()(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const { return a == b; }
};

struct HashPoint {
  std::size_t operator()(const Eigen::Vector3d& p) const {
    std::uint64_t hash = 0;
    for (int i = 0; i < 3; ++i) {
      const double value = p[i] == 0.0 ? 0.0 : p[i];  // -0 equals 0
      hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

bool has_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  // The height over the longer side, relative to it, must exceed rounding.
  return ab.cross(ac).norm() > 1e-12 * std::max(ab.squaredNorm(), ac.squaredNorm());
}

}  // namespace

TriangleMesh cleaned(const TriangleMesh& mesh) {
  TriangleMesh result;
  std::unordered_map<Eigen::Vector3d, std::uint32_t, HashPoint, SamePoint> index_of;
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[triangle[0]];
    const Eigen::Vector3d& b = mesh.vertices[triangle[1]];
    const Eigen::Vector3d& c = mesh.vertices[triangle[2]];
    if (!has_area(a, b, c)) {
      continue;
    }
    std::array<std::uint32_t, 3> joined{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& vertex = mesh.vertices[triangle[k]];
      const auto next = static_cast<std::uint32_t>(result.vertices.size());
      const auto [entry, is_new] = index_of.try_emplace(vertex, next);
      if (is_new) {
        result.vertices.push_back(vertex);
      }
      joined[k] = entry->second;
    }
    result.triangles.push_back(joined);
  }
  return result;
}

}  // namespace handway::geometric
