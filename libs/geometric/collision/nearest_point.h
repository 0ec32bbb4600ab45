#pragma once

#include "collision/box_tree.h"
#include "handway/geometric/scene/triangle_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace handway::geometric {

/// The point of a mesh's surface that is nearest to another point.
struct NearestPoint {
  Eigen::Vector3d point;
  double distance;  ///< m
  std::uint32_t triangle;
};

/// Corners of a triangle, in the mesh's frame.
[[nodiscard]] inline std::array<Eigen::Vector3d, 3> corners(const TriangleMesh& mesh,
                                                            std::uint32_t triangle) {
  const auto& [i, j, k] = mesh.triangles[triangle];
  return {mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]};
}

/// The point of the triangle that is nearest to `p`.
///
/// Source: Ericson, "Real-Time Collision Detection", 2005, section 5.1.5.
[[nodiscard]] Eigen::Vector3d nearest_on_triangle(const std::array<Eigen::Vector3d, 3>& triangle,
                                                  const Eigen::Vector3d& p);

/// @param hint a triangle to begin with: the nearer it is, the sooner it ends.
[[nodiscard]] NearestPoint nearest_point(const TriangleMesh& mesh, const BoxTree& boxes,
                                         const Eigen::Vector3d& p, std::uint32_t hint = 0);

}  // namespace handway::geometric
