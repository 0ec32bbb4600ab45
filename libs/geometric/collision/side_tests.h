#pragma once

#include "collision/sided_boxes.h"
#include "collision/sphere_bounds.h"
#include "collision/sphere_cover.h"
#include "collision/surface_points.h"

namespace handway::geometric {

/// Whether points of surface A lie on both sides of a piece of surface B for sure: then the
/// surfaces cross.
/// @param around it is looked for no farther than this reaches, in A's frame. @param X_BA pose
/// of A's frame in B's.
[[nodiscard]] bool surely_pierces(const SurfacePoints& a, const BoundingSphere& around,
                                  const SurfaceSides& b, const FloatPose& X_BA);

/// A lower bound (m) of the distance of surface A from surface B: how far A's box is inside of
/// a box outside of each of B's pieces; 0 or less if it says nothing.
/// @param centre,half of a box that contains A, along the axes of A's frame, m.
[[nodiscard]] float gap_outside(const Eigen::Vector3f& centre, const Eigen::Vector3f& half,
                                const SurfaceSides& b, const FloatPose& X_BA);

}  // namespace handway::geometric
