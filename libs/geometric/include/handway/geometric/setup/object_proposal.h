#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/mesh/point_cloud.h"
#include "handway/geometric/scene/scene.h"

#include <vector>

namespace handway::geometric {

/// Finds level surfaces, such as tables and shelf boards, in the points of a camera, and what
/// stands on them, and describes both by primitives.
///
/// Supports are clusters of points with upright normals at one height, of at least 0.05 m²; each
/// becomes a box of 20 mm below that height over the smallest rectangle around its points. Points
/// above a support fall into clusters, 20 mm apart; each becomes the box, the upright cylinder or
/// the sphere that fits its points best. Hidden sides are where the primitive has them.
/// @param X_WC pose of the cloud in the world, whose z axis points up.
/// @returns objects in the world, named "surface" and "object", supports first, the largest in
/// front; empty if there is no support. Their colours are the means of those of their points, if
/// these have colours.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<SceneObject> propose_objects(
    const PointCloud& cloud, const Pose& X_WC);

}  // namespace handway::geometric
