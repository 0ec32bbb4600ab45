#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <span>

namespace handway::geometric {

/// The surface of the convex hull of `points` (m), its triangles counterclockwise seen from
/// outside. Points without volume (fewer than four, or all in one plane) give an empty mesh.
///
/// Source: C. B. Barber, D. P. Dobkin, H. Huhdanpaa, "The Quickhull algorithm for convex hulls",
/// ACM Trans. on Mathematical Software 22, 1996 (qhull).
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT TriangleMesh
convex_hull(std::span<const Eigen::Vector3d> points);

}  // namespace handway::geometric
