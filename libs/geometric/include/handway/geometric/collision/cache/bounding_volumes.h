#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace handway::geometric {

/// A sphere of a sphere tree, m.
struct CoveringSphere {
  Eigen::Vector3d centre;
  double radius = 0.0;
};

/// Bounding volumes that ExactCollisionChecker tests before any triangles, for display; in the
/// body's frame.
struct BoundingVolumes {
  /// Spheres of the sphere tree: together they contain the surface.
  std::vector<CoveringSphere> spheres;
  /// The convex hull that separating planes are found with, grown if it is flat. The surface is
  /// nowhere farther out than `margin`, m.
  TriangleMesh hull;
  double margin = 0.0;
};

/// Returns the volumes of `meshes`, in order. They are those of the checker: made once, and stored
/// in the user's cache.
/// @param largest (m) a larger sphere of the tree is replaced by its children, up to sixteen, if
/// any; 0: the smallest.
/// @pre each mesh has a triangle.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<BoundingVolumes> bounding_volumes(
    const std::vector<std::shared_ptr<const TriangleMesh>>& meshes, double largest);

}  // namespace handway::geometric
