#pragma once

#include "handway/geometric/scene/triangle_mesh.h"

namespace handway::geometric {

/// Is a point inside of a closed mesh? Counts the triangles that rays in three directions
/// cross, and takes the majority: a ray that grazes an edge may count wrongly.
/// @param p in the mesh's frame.
[[nodiscard]] bool is_inside(const TriangleMesh& mesh, const Eigen::Vector3d& p);

}  // namespace handway::geometric
