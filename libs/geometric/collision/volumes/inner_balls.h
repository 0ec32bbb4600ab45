#pragma once

#include "collision/volumes/triangle_tree.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace handway::geometric {

/// A ball inside a closed surface, m.
struct InnerBall {
  Eigen::Vector3f centre;
  float radius = 0.0F;  ///< The surface is at least this far from the centre.
};

/// Returns a few large balls inside a mesh, the largest first: whatever comes nearer to a centre
/// than the radius enters the body. There are none in a mesh that is not closed.
/// @param triangles of the mesh. @pre the mesh has a triangle.
[[nodiscard]] std::vector<InnerBall> inner_balls(const TriangleMesh& mesh,
                                                 const TriangleTree& triangles);

}  // namespace handway::geometric
