#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/shape.h"

#include <Eigen/Core>

#include <utility>
#include <vector>

/// Shapes of other programs in terms of our own.
namespace handway::geometric {

/// A capsule along z, centred: its cylinder and the balls at its ends, with their poses in its
/// frame.
/// @param length m, of the cylinder alone.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::pair<Shape, Pose>> capsule_shapes(
    double radius, double length);

/// An ellipsoid with these radii (m) along its axes: a mesh around it that leaves it by at most 0.7
/// % of them.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Mesh ellipsoid_mesh(const Eigen::Vector3d& radii);

}  // namespace handway::geometric
