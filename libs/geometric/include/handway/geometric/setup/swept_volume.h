#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/scene/scene.h"

#include <stop_token>
#include <vector>

namespace handway::geometric {

/// The surface of the volume that a robot's links pass through in `postures` (world, m), as smooth
/// as cells of `cell` (m) allow; links that don't move among them are left out. For display, not
/// for collision checks. Empty if `stop` comes first.
///
/// Cells that contain surface points of the links are filled; the faces between filled and empty
/// ones are smoothed by moving their corners towards the middle of their neighbours.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT TriangleMesh
swept_volume(const RobotInstance& robot, const std::vector<Configuration>& postures, double cell,
             const std::stop_token& stop);

}  // namespace handway::geometric
