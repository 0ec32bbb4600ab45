#pragma once

#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <random>
#include <string>
#include <vector>

namespace handway::geometric::test {

struct SampleMesh {
  std::string name;
  TriangleMesh mesh;
};

/// Solids, a plate without thickness, a single triangle, slivers.
inline std::vector<SampleMesh> sample_meshes() {
  TriangleMesh plate{{{0, 0, 0}, {1, 0, 0}, {1, 0.5, 0}, {0, 0.5, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  TriangleMesh triangle{{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0.02}}, {{0, 1, 2}}};
  TriangleMesh needle{{{0, 0, 0}, {0.2, 0, 0}, {0.1, 1e-6, 0}}, {{0, 1, 2}}};
  TriangleMesh point{{{0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}}, {{0, 1, 2}}};
  TriangleMesh two_balls = *tessellate(Sphere{0.03});
  append(two_balls,
         transformed(*tessellate(Sphere{0.02}), Pose(Eigen::Translation3d(0.2, 0.05, 0.0))));
  return {{"box", *tessellate(Box{{0.4, 0.1, 0.02}})},
          {"can", *tessellate(Cylinder{0.03, 0.12})},
          {"plate", plate},
          {"triangle", triangle},
          {"needle", needle},
          {"point", point},
          {"two balls", two_balls}};
}

/// A point within a box `share` times as large as the mesh's, and at least 5 cm.
class RandomPoints {
 public:
  RandomPoints(const TriangleMesh& mesh, double share) : box_(bounding_box(mesh)), share_(share) {}

  Eigen::Vector3d next() {
    const Eigen::Vector3d half = (0.5 * share_ * box_.size()).cwiseMax(0.05);
    return box_.centre() + half.cwiseProduct(Eigen::Vector3d(draw(), draw(), draw()));
  }

  /// Returns a point on the surface, of any triangle.
  Eigen::Vector3d next_on(const TriangleMesh& mesh, std::uint32_t& triangle) {
    triangle = std::uniform_int_distribution<std::uint32_t>(
        0, static_cast<std::uint32_t>(mesh.triangles.size()) - 1)(engine_);
    const auto& [a, b, c] = mesh.triangles[triangle];
    double u = 0.5 * (draw() + 1.0);
    double v = 0.5 * (draw() + 1.0);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    return mesh.vertices[a] + u * (mesh.vertices[b] - mesh.vertices[a]) +
           v * (mesh.vertices[c] - mesh.vertices[a]);
  }

 private:
  double draw() { return std::uniform_real_distribution<double>(-1.0, 1.0)(engine_); }

  Aabb box_;
  double share_;
  std::mt19937_64 engine_{1};
};

}  // namespace handway::geometric::test
