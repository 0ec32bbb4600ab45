#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <span>

namespace handway::geometric {

/// The surface of the convex hull of `points` (m), its triangles counterclockwise seen from
/// outside. Points that span no volume (fewer than four, or all in one plane) give an empty mesh.
///
/// Point by point: those faces that a point sees are replaced by the cone from it to their rim.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT TriangleMesh
convex_hull(std::span<const Eigen::Vector3d> points);

}  // namespace handway::geometric
