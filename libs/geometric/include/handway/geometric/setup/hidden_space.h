#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/depth_camera.h"
#include "handway/geometric/mesh/point_cloud.h"
#include "handway/geometric/mesh/triangle_mesh.h"

namespace handway::geometric {

/// Returns the centres of the cells that a depth camera can't see, since something that it has
/// seen is in front of them: cells whose centre projects to a measured pixel, and is farther from
/// the camera than its depth by more than the diagonal of a cell. Cells that project to a pixel
/// without a measurement, or beside the image, are not among them.
/// @param seen points of the camera, in its optical frame.
/// @param X_WC pose of that frame in the world.
/// @param box region of the world whose cells are looked at, m.
/// @param cell edge of a cell, m, > 0.
/// @returns points relative to the lower corner of `box`, along the axes of the world, with `cell`
/// as PointCloud::cell.
/// @throws InputError if the box has more than kMostCloudPoints cells.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT PointCloud hidden_cells(const PointCloud& seen,
                                                               const DepthCamera& camera,
                                                               const Pose& X_WC, const Aabb& box,
                                                               double cell);

}  // namespace handway::geometric
